//! The gears as files for CAD, printing and viewing.

pub mod assembly;
pub mod gltf;
pub mod stl;
pub mod xyz;

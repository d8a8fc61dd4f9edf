//! From parameters to constants: inertias, contact laws, meshes, effects, gathered in `Model`.

pub mod additions;
pub mod bodies;
pub mod face;
pub mod ideal;
pub mod laws;
pub mod model;
pub mod rigid;
mod solid;
pub mod teeth;

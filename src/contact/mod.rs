//! Tooth contact: the law of one pair, and the elastic potential of a mesh.

pub mod any_spring;
pub mod damping;
pub mod detailed;
pub mod errors;
pub mod gaps;
pub mod hertz;
pub mod impact;
mod kinks;
pub mod law;
pub mod mesh;
pub mod pairs;
pub mod solid;
mod spec;
pub mod spring;
pub mod state;
pub mod stiffness;

pub use spec::{ContactLaw, ContactSpec, DampingModel};

#[cfg(feature = "tooth_friction")]
pub mod tooth_friction;
#[cfg(not(feature = "tooth_friction"))]
#[path = "no_tooth_friction.rs"]
pub mod tooth_friction;

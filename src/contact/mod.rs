//! Tooth contact: laws of one tooth pair, the elastic potential of a mesh with its forces and derivatives, tooth
//! errors, friction along the flanks, and contact of solid teeth.
//!
//! Everything in this module is a function of a mesh's position and rates. Degrees of freedom, time and steps belong to
//! `model`.

pub mod bodies;
pub mod damping;
pub mod detailed;
pub mod errors;
pub mod gaps;
pub mod hertz;
pub mod impact;
mod kinks;
pub use kinks::WORTHWHILE;
pub mod mesh;
pub mod pair_load;
pub mod pairs;
pub mod planet;
pub mod shared;
pub mod solid;
mod spec;
pub mod spring;
pub mod state;
pub mod stiffness;
pub mod tooth_friction;
pub mod tooth_load;

pub use damping::Damping;
pub use gaps::FlankGaps;
pub use impact::Impact;
pub use mesh::Mesh;
pub use pairs::{Engagement, Flank, Spot, ToothPair};
pub use spec::{ContactLaw, ContactSpec, DampingModel};
pub use spring::{AnySpring, Elastic, Spring};
pub use tooth_friction::{Sliding, ToothFriction};
pub use tooth_load::{ToothLoad, Touch};

//! Geometry of a straight bevel pair with spherical-involute flanks, on the unit sphere and scaled with the cone
//! distance R: cones, line of action, tip corners, assembly of planets, validation of parameters, and solids.
//!
//! Forces and motion belong to `contact` and `model`.

pub mod action;
pub mod addendum;
pub mod assembly;
pub mod checks;
pub mod corner;
pub mod involute;
pub mod pair;
pub mod solid;
mod spec;

pub use corner::{CornerGap, CornerTravel};
pub use involute::Gear;
pub use pair::{Pair, Path, Tredgold};
pub use spec::{AddendumSystem, GearSpec, PlainTeeth};

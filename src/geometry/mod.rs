//! Geometry of a straight bevel pair with spherical-involute flanks: lives on the unit sphere, scales with R.

pub mod action;
pub mod addendum;
pub mod assembly;
pub mod checks;
pub mod corner;
pub mod involute;
pub mod pair;
pub mod solid;
mod spec;

pub use pair::{Pair, Path, Tredgold};
pub use spec::{AddendumSystem, GearSpec};

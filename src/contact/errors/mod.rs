//! Tooth errors: the gap e(R, s), material that each tooth pair lacks along the line of action.
//!
//! A pair of error-free teeth penetrates at cone distance R by R (a − g); with errors by d = R (a − g) − e(R, s), e ≥ 0
//! being missing material. To first order errors add up, one file each: pitch deviations (`pitch`), runout (`runout`), tip
//! relief (`relief`), lengthwise crowning (`crowning`), and misalignment (`misalignment`). A broken tooth (`chip`) is
//! separate, because it appears during a run.

mod all;
mod chip;
mod crowning;
mod individual;
mod misalignment;
mod normals;
pub mod pitch;
mod random;
mod relief;
mod runout;
mod spec;

pub use all::ToothErrors;
pub use chip::Chip;
pub use individual::GearTeeth;
pub use normals::{ContactNormals, Normal};
pub use random::Random;
pub use spec::{FaultyGear, ToothErrorSpec, ToothFaultSpec};

use super::Flank;

/// A mesh of a differential.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshId {
    /// Number of the planet.
    pub planet: usize,
    /// Side gear: 0 left, 1 right.
    pub side: usize,
}

/// A tooth pair of a mesh.
///
/// Planet teeth are numbered in the direction of positive spin (about the axis pointing to the apex), side gear teeth in
/// the direction of forward rotation (about +x̂), both from any tooth of the gear; numbers may exceed a revolution.
/// At the left mesh both counts run along t, the way a planet is carried forward; at the right mesh that of the planet
/// runs against it. While a gear turns forward, teeth of falling number come into its mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairId {
    /// Number of the planet's tooth.
    pub planet_tooth: usize,
    /// Number of the side gear's tooth.
    pub side_tooth: usize,
    /// Flanks in contact.
    pub flank: Flank,
}

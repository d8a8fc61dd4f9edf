//! Tooth errors: the gap e(R, s), which is the material that a tooth pair lacks along the line of action.
//!
//! A pair of error-free teeth penetrates by R (a − g) at cone distance R. With errors, it penetrates by d = R (a − g) −
//! e(R, s), where e ≥ 0 means missing material. To first order, errors add up. Each has its own file: pitch deviations
//! (`pitch`), runout (`runout`), tip relief (`relief`), lengthwise crowning (`crowning`), and misalignment
//! (`misalignment`). A broken tooth (`chip`) is separate, because it appears during a run.

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
pub use spec::{FaultyGear, ToothErrorSpec, ToothFaultSpec, breaks};

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
/// Planet teeth are numbered in the direction of positive spin (about the axis pointing to the apex). Side gear teeth
/// are numbered in the direction of forward rotation (about +x̂). Both counts start at any tooth of the gear, and
/// numbers may exceed a revolution. At the left mesh, both counts run along t, the direction in which a planet is
/// carried forward. At the right mesh, the planet's count runs against t. While a gear turns forward, teeth with
/// decreasing numbers enter its mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairId {
    /// Number of the planet's tooth.
    pub planet_tooth: usize,
    /// Number of the side gear's tooth.
    pub side_tooth: usize,
    /// Flanks in contact.
    pub flank: Flank,
}

//! What the teeth stand on: the bodies of both gears, from the root cone down to where they are held.
//!
//! Slices of a straight bevel gear are similar, and under a line load w = ωR so is the motion: u = R U(φ, ζ) with the polar
//! angle φ from the gear's axis and the azimuth ζ. A body is then a hollow cone whose displacements are Fourier series in ζ
//! (`cone`). A tooth loads it over its root section (`root`), as Weber's beam does. A gear's body (`body`) gives how far a load
//! on one tooth moves this tooth and others, and both gears together how pairs of teeth share a rotation (`mesh`). While
//! the gears turn, `sharing` says how pairs move each other.

mod body;
mod cone;
mod mesh;
mod polynomial;
mod root;
mod sharing;
mod support;

pub use body::GearBody;
pub use mesh::MeshOnBodies;
pub use root::{RootLoad, RootPatch};
pub use sharing::{Coupling, PairCouplings, PairPlace, Pull};
pub use support::Support;

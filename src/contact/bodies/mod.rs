//! Elastic bodies of both gears under their teeth, from the root cone down to the surface on which each body is held.
//!
//! Slices of a straight bevel gear are similar. Under a line load w = ωR, their motion is similar too: u = R U(φ, ζ),
//! with the polar angle φ from the gear's axis and the azimuth ζ. A body is then a hollow cone whose displacements are
//! Fourier series in ζ (`cone`). A tooth loads the body over the tooth's root section (`root`), as Weber's beam does.
//! `body` computes how far a load on one tooth moves this tooth and others. `mesh` combines the bodies of both gears,
//! so that tooth pairs can share a rotation. `sharing` provides the couplings between pairs while the gears turn.

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
pub use sharing::{Coupling, LoadedPair, PairCouplings, Pull};
pub use support::Support;

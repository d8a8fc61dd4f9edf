//! Contact of solid teeth: faceted flanks pressed together, detected and measured only from geometry.
//!
//! Flanks are plane facets between rays from the apex of their gear, like those of an exported solid. Bounding boxes
//! find the teeth that can meet ([`candidates`]). In the actual position of the gears ([`pose`]), misaligned or not,
//! both flanks of a section are polygons ([`polygon`]). A walk along their corners ([`walk`]) measures the overlap
//! ([`overlap`]), with exact derivatives with respect to the angles of both gears ([`turned`]). Every section follows
//! the law of a pair ([`mesh`]). The path of contact only determines where a walk begins.

mod candidates;
mod exponential;
pub mod flank;
pub mod loads;
pub mod mesh;
pub mod overlap;
mod polygon;
pub mod pose;
mod softness;
mod turned;
mod walk;

pub use pose::{Displacement, MAX_TEETH, Placement, SineCosine, ToothAngles, TurningRay};
pub use softness::Softness;

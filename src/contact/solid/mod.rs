//! Contact of solid teeth: faceted flanks pressed together, detected and measured by geometry alone.
//!
//! Flanks are plane facets between rays from the apex of their gear, as an exporter of solids makes them. Bounding boxes give
//! the teeth that can meet ([`candidates`]). With the gears in their actual position ([`pose`]), misaligned or not, both
//! flanks of a section are polygons ([`polygon`]). A walk along their corners ([`walk`]) measures the overlap
//! ([`overlap`]), with exact derivatives by the angles of both gears ([`turned`]); every section follows the law of a pair
//! ([`mesh`]). The path of contact only tells where a walk begins.

mod candidates;
mod exponential;
pub mod flank;
mod loads;
pub mod mesh;
pub mod overlap;
mod polygon;
pub mod pose;
mod softness;
mod turned;
mod walk;

pub use pose::{Displacement, MOST_TEETH, Placement, SineCosine, ToothAngles, TurningRay};
pub use softness::Softness;

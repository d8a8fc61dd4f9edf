//! Contact of solid teeth: faceted flanks pressed together, detected and measured by geometry alone.
//!
//! Flanks are plane facets between rays from the apex of their gear, as an exporter of solids makes them. No line of action
//! and no path of contact is used. Bounding boxes give the teeth that can meet ([`candidates`]); their overlap is measured
//! section by section across the face ([`overlap`]) with the gears in their actual position ([`pose`]), misaligned or
//! not; every section follows the law of a pair ([`mesh`]).

mod candidates;
mod exponential;
pub mod flank;
mod loads;
pub mod mesh;
pub mod overlap;
mod polygon;
pub mod pose;
mod turned;
mod walk;

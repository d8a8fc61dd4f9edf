//! Contact of solid teeth: faceted flanks pressed together, found and measured by geometry alone.
//!
//! Flanks are what an exporter of solids makes of them: plane facets between rays from the apex of their gear. Neither
//! line of action nor path of contact is known here. Where teeth can meet is found among their boxes ([`candidates`]);
//! how deep they overlap is measured section by section across the face ([`overlap`]) with the gears placed as they
//! are ([`pose`]), misaligned or not; every section then follows the law of a pair ([`mesh`]).

mod candidates;
mod exponential;
pub mod flank;
pub mod mesh;
pub mod overlap;
mod polygon;
pub mod pose;

//! The gears as solids: outlines of teeth with their fillets, closed surfaces of whole gears, mass properties, and the
//! check for interference.

pub mod fillet;
pub mod interference;
pub mod manifold;
pub mod mass;
pub mod outline;
pub mod skin;

pub use fillet::Foot;
pub use interference::Interference;
pub use manifold::{GearSolid, Shape};
pub use outline::{Node, Outline, Part};

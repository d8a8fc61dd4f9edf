//! The gears as solids: outlines of teeth with their fillets, closed surfaces of whole gears, mass properties, and the check
//! for interference.

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

#[cfg(test)]
mod interference_tests;
#[cfg(test)]
mod mass_tests;
#[cfg(test)]
mod tests;

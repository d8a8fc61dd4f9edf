//! What can be read from a simulation under its present inputs, and what a simulation reports once.

mod motion_and_forces;
mod reports;

pub use motion_and_forces::CostClass;
pub use reports::Reported;

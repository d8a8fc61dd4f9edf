//! Readings of a simulation under its present inputs, and warnings that a simulation reports once.

mod description;
mod ledger;
mod motion_and_forces;
mod present;
mod reports;

pub use description::CostClass;
pub use reports::Reported;

//! A running simulation: its start, its steps, events, the ledger, and model exchange.

mod events;
mod exchange;
mod failure;
mod imposed;
mod ledger;
mod sensitivity;
mod simulation;
mod start;
mod stretch;

pub use exchange::{BODIES, Body, INDICATORS, STATES, Update};
pub use failure::StepFailure;
pub use sensitivity::{Along, Direction, PLACES};
pub use simulation::{CostClass, Simulation};

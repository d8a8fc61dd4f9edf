//! A running simulation and its steps: integration between events, the ledger, and failures.

mod completed_step;
pub mod effort;
pub mod events;
pub mod failure;
pub mod hints;
pub mod imposed;
mod integration;
pub mod ledger;
pub mod progress;
mod simulation;
pub mod timeline;
mod watching;

pub use failure::{StepFailure, six_digits};
pub use ledger::{LedgerEquations, LedgerSums};
pub use simulation::Simulation;

//! A running simulation and its steps: integration between events, the ledger, and failures.

pub mod accepted;
mod change;
mod completed_step;
pub mod effort;
pub mod events;
pub mod failure;
pub mod hints;
pub mod imposed;
mod input_ramp;
mod integration;
pub mod ledger;
pub mod progress;
mod simulation;
pub mod timeline;
pub mod watching;
mod widened;

pub use accepted::Accepted;
pub use failure::{StepFailure, six_digits};
pub use input_ramp::HostInputs;
pub use ledger::{LedgerEquations, LedgerSums};
pub use simulation::Simulation;
pub use watching::Watched;
#[cfg(test)]
pub use widened::Widened;

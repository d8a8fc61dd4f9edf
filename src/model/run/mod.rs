//! A running simulation: its start, its steps, events, the ledger, and model exchange.

mod carried;
mod completed_step;
mod effort;
mod equilibrium;
mod events;
mod exchange;
mod failure;
mod hints;
mod imposed;
mod integration;
mod ledger;
mod periodic;
mod progress;
mod readings;
mod reports;
mod sensitivity;
mod simulation;
mod start;
mod start_report;
mod steady_heat;
mod timeline;
mod watching;

pub use exchange::{BODIES, Body, INDICATORS, STATES, Update};
pub use failure::{StepFailure, six_digits};
pub use ledger::{LedgerEquations, LedgerSums};
pub use readings::CostClass;
pub use reports::Reported;
pub use sensitivity::{Direction, StencilReadings};
pub use simulation::Simulation;

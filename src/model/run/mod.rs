//! A running simulation and its steps.
//!
//! `step` shows a step from the inputs of the host to the requested time; its comment lists the parts in their order.
//! The other files contain the details:
//!
//! - `change`, `imposed`, `events`, `moving_inputs`: changes of torques and of imposed speeds, other changes of the
//!   equations, and inputs that change during a step;
//! - `interval`: start and end of an interval of the integrator's clock; `without_solver`: motion that needs no new step;
//! - `by_shape`: equations in the shape of the scene;
//! - `ledger`: work, heat and temperatures of a completed step; `watching`: its fatigue damage and its mesh history,
//!   along its dense output (`completed_step`);
//! - `budget`, `failure`, `effort`, `hints`: limit of attempts; errors, their causes and remedies.
//!
//! `coupling` records the exchange with the host, in scenes with advice about the communication step.
//!
//! Before a call, `input_ramp` turns jumps of inputs into ramps. In model exchange, `accepted` stores the end of the
//! last step of the host's solver.

pub mod accepted;
mod budget;
pub mod by_shape;
mod change;
mod completed_step;
pub mod coupling;
pub mod effort;
pub mod events;
pub mod failure;
pub mod hints;
pub mod imposed;
mod input_ramp;
pub mod interval;
pub mod ledger;
pub mod moving_inputs;
mod simulation;
mod step;
pub mod watching;
mod without_solver;

pub use accepted::Accepted;
pub use failure::{StepFailure, six_digits};
pub use input_ramp::HostInputs;
pub use ledger::LedgerEquations;
pub use simulation::Simulation;

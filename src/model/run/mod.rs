//! A running simulation and its steps. In the order of a call of `Simulation::advance_by`:
//!
//! 1. `simulation` applies changed inputs. If only torques change, the pending step is completed and the integration
//!    continues (`change`). After any other change, the integration restarts (`progress::restart` with `imposed` and
//!    `events`).
//! 2. If the pending step contains the requested time, the state moves within this step, and the call is finished.
//! 3. Otherwise, `progress` integrates from stop to stop. Stops are given by `dynamics::timeline`: the requested time, a
//!    change of the equations, or a reset of the integrator's clock.
//! 4. `integration` integrates one interval. Its module comment gives the order of a single step.
//! 5. `ledger` records each completed step: work, heat and temperatures. `watching` adds its fatigue damage and its
//!    mesh history, along the dense output of the step (`completed_step`).
//! 6. `progress` checks that the integration has reached the stop. Errors are explained by `failure`, `effort` and
//!    `hints`.
//!
//! `coupling` records the exchange with the host, in scenes with advice about the communication step.
//!
//! Before a call, `input_ramp` turns jumps of inputs into ramps. In model exchange, `accepted` stores the end of the
//! last step of the host's solver.

pub mod accepted;
mod change;
mod completed_step;
pub mod coupling;
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
pub mod watching;

pub use accepted::Accepted;
pub use failure::{StepFailure, six_digits};
pub use input_ramp::HostInputs;
pub use ledger::{LedgerEquations, LedgerSums};
pub use simulation::Simulation;

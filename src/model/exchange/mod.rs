//! Model exchange, in which the host's solver integrates the states, and sensitivities:
//!
//! - `states`: continuous states and event indicators; `rates`: the equations of motion as functions of the states;
//! - `steps`: completed steps and events;
//! - `sensitivity`: directional derivatives of rates and outputs.

mod rates;
mod sensitivity;
mod states;
mod steps;

pub use sensitivity::{Direction, StencilReadings};
pub use states::{BODIES, Body, INDICATORS, STATES};
pub use steps::Update;

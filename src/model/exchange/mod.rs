//! Model exchange, in which a solver of the host integrates the states; and derivatives of what can be read.

mod sensitivity;
mod steps;

pub use sensitivity::{Direction, StencilReadings};
pub use steps::{BODIES, Body, INDICATORS, STATES, Update};

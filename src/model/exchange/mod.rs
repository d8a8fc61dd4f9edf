//! Model exchange, in which a solver of the host integrates the states; and derivatives of what can be read.

mod rates;
mod sensitivity;
mod states;
mod steps;

pub use sensitivity::{Direction, StencilReadings};
pub use states::{BODIES, Body, INDICATORS, STATES};
pub use steps::Update;

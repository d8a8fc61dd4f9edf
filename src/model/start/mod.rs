//! The start of a simulation: speeds, the equilibrium of loaded teeth, and steady temperatures.

mod carried;
mod equilibrium;
mod periodic;
pub mod preload;
pub mod report;
mod steady_heat;

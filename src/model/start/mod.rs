//! The start of a simulation: speeds, the equilibrium of loaded teeth, and steady temperatures.

mod carried;
mod equilibrium;
mod first_state;
mod periodic;
mod preload;
mod report;
mod steady_heat;

//! The start of a simulation. In the order of a start:
//!
//! - `first_state`: speeds, and the calls of the other modules;
//! - `preload`: teeth are pressed together and half-shafts wound up, by the torques from `carried`, with dry friction from
//!   `friction`, and the search in `equilibrium`;
//! - `report`: warnings about the result;
//! - `steady_heat`: steady temperatures, and `periodic`: the check that they exist.

mod carried;
mod equilibrium;
mod first_state;
mod friction;
mod periodic;
mod preload;
mod report;
mod steady_heat;

//! The differential as a mechanical system: parameters → plan → equations → readings.

mod bodies;
mod constants;
mod ideal;
mod parameters;
mod plan;
mod readings;
mod resultants;
mod simulation;
mod start;
mod state;
mod teeth;

pub use bodies::Inertias;
pub use parameters::{
    CarrierDrive, Effects, GearContact, InertiaSpec, Inputs, Material, Method, Parameters, PlanetSpin, Scene,
    SolverSpec, Start,
};
pub use plan::Plan;
pub use readings::{Books, Forces, MAX_PLANETS, MeshForces, Motion, efficiency};
pub use simulation::{Simulation, StepFailure};
pub use state::State;

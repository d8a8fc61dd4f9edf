//! The differential as a mechanical system: parameters → plan → equations → readings.

mod bodies;
mod combinations;
mod commands;
mod constants;
mod dry;
mod effects;
mod equations;
mod full;
mod ideal;
mod laws;
mod loads;
mod parameters;
mod plan;
mod readings;
mod resultants;
mod rigid;
mod run;
mod simulation;
mod start;
mod state;
#[cfg(feature = "strength")]
mod strength;
#[cfg(not(feature = "strength"))]
#[path = "no_strength.rs"]
mod strength;
mod teeth;
mod tooth_effects;

pub use bodies::Inertias;
pub use effects::{
    BearingDragSpec, CAUSES, Cause, EffectSpecs, FinalDriveSpec, HalfShaftSpec, LimitedSlipSpec, LockSpec,
    PinComplianceSpec, StrengthSpec, ThrustFrictionSpec,
};
pub use loads::ToothLoad;
pub use parameters::{
    CarrierDrive, Effects, GearContact, InertiaSpec, Inputs, Material, Method, Parameters, PlanetSpin, Scene,
    SideDrive, SolverSpec, Start,
};
pub use plan::{Group, Plan};
pub use readings::{Books, Forces, MAX_PLANETS, MeshForces, Motion, Stresses, efficiency};
pub use simulation::{CostClass, Simulation, StepFailure};
pub use state::State;

//! The differential as a mechanical system: parameters → plan → equations → readings.

mod beside;
mod bodies;
mod causes;
mod combinations;
mod commands;
mod constants;
mod continuous;
mod course;
mod cycle;
mod dry;
mod effect_specs;
mod effects;
mod equations;
mod face;
mod failure;
mod full;
mod grip;
mod ideal;
mod laws;
mod layout;
mod loads;
mod motion;
mod parameters;
mod plan;
mod power;
mod readings;
mod records;
mod resultants;
mod rigid;
mod run;
mod sensitivity;
mod simulation;
mod sizes;
mod solid;
mod start;
mod state;
#[cfg(feature = "strength")]
mod strength;
#[cfg(not(feature = "strength"))]
#[path = "no_strength.rs"]
mod strength;
mod switches;
mod teeth;
mod tooth_effects;

pub use bodies::Inertias;
pub use causes::{CAUSES, Cause};
pub use continuous::{BODIES, Body, INDICATORS, STATES, Update};
pub use course::{Course, ORDERS};
pub use effect_specs::{
    BearingDragSpec, EffectSpecs, FinalDriveSpec, HalfShaftSpec, LimitedSlipSpec, LockSpec, PinComplianceSpec,
    StrengthSpec, ThrustFrictionSpec,
};
pub use failure::StepFailure;
pub use layout::MAX_PLANETS;
pub use loads::{ToothLoad, Touch};
pub use parameters::{
    CarrierDrive, Effects, GearContact, InertiaSpec, Inputs, Material, Method, Parameters, PlanetSpin, Scene,
    SideDrive, SolidTeeth, SolverSpec, Start,
};
pub use plan::{Group, Plan};
pub use readings::{Books, Forces, MeshForces, Motion, Stresses, efficiency};
pub use sensitivity::{Along, Direction, PLACES};
pub use simulation::{CostClass, Simulation};
pub use state::{Accepted, State};

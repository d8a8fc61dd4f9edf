//! The differential as a mechanical system. Modules in the order of their dependencies:
//!
//! - `scene`: drives, inputs, material, integration, and the plan of bodies,
//! - `thermal`: temperatures,
//! - `effect_kinds`: forces on bodies, dry friction and changes to teeth, of which effects consist,
//! - `effects`: the effects, one file each, and their list,
//! - `setup`: all parameters, and checks for contradictions,
//! - `assembly`: constants computed from the parameters,
//! - `dynamics`: the equations of motion and their state,
//! - `outputs`: motion, forces and ledger values as they are computed from a state,
//! - `run`: a running simulation; its module comment gives the order of a step,
//! - `readings`: values read from a simulation, and its reports,
//! - `start`: the start of a simulation,
//! - `exchange`: model exchange, and sensitivities.

mod assembly;
mod dynamics;
mod effect_kinds;
pub mod effects;
mod exchange;
mod outputs;
mod readings;
mod run;
mod scene;
mod setup;
mod start;
mod thermal;

pub use crate::contact::tooth_load::{ToothLoad, Touch};
pub use assembly::gear_cache::{GearCache, Share};
pub use assembly::inertias::Inertias;
pub use assembly::model::Given;
pub use dynamics::event::{AdvanceOptions, Event, Events, Happening};
pub use dynamics::state::State;
pub use effect_kinds::effect::{Changes, Class, Heat, InputField, Needs, Reading, Refinement};
pub use effects::{DogSides, EFFECTS, EffectParameters, Effects, FinalDriveSpec, Hand, Memories, RingSide};
pub use exchange::{BODIES, Body, Direction, INDICATORS, STATES, StencilReadings, Update};
pub use outputs::forces::MeshForces;
pub use outputs::forces::{Forces, efficiency};
pub use outputs::ledger_readings::{HELD, LedgerReadings};
pub use outputs::motion::Motion;
pub use outputs::pairs::{PairLine, PairLines, TOOTH_PAIRS};
pub use readings::{CostClass, Reported};
pub use run::{Accepted, HostInputs, Simulation, StepFailure, six_digits};
pub use scene::layout::MAX_PLANETS;
pub use scene::{
    CarrierDrive, GearContact, Group, InertiaSpec, InputDerivatives, Inputs, Layout, MAX_SPEED, MAX_TORQUE, Material,
    Method, ORDERS, Plan, PlanetSpin, Scene, SideDrive, SolidTeeth, SolverSpec, Start,
};
pub use setup::ATTACHED;
pub use setup::Parameters;
pub use setup::advice::turned_backward;
pub use setup::effect_outputs::{ALL_HEATS, CONTACT_HEAT, readings};

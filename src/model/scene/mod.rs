//! Scene without effects: drives, inputs, material, integration, and the plan of its bodies.

mod dog;
mod input_derivatives;
mod inputs;
pub mod layout;
mod material;
mod oil;
pub mod plan;
mod rubbing;
mod solver;

pub use crate::drives::{CarrierDrive, GearContact, PlanetSpin, Scene, SideDrive, Start};
pub use dog::{Dog, DogMotion, DogPhase, Dogs};
pub use input_derivatives::{InputDerivatives, ORDERS};
pub use inputs::{ACTUATED, ACTUATED_CLUTCHES, ACTUATED_LOCK, Inputs, MAX_SPEED, MAX_TORQUE};
pub use layout::{
    ATTACHED_COUNT, CARRIER, ENDS, FEW, Layout, MAX_DOF, MAX_GROUPS, MAX_PLANETS, PINION, PLANET, PROPELLER,
};
pub use material::{InertiaSpec, Material};
pub use oil::{OilSpec, Viscosity};
pub use plan::{AttachedBody, Base, Group, Plan, Requests};
pub use rubbing::{PAIRS, PINION_PAIR, RubbingKind, RubbingPair};
pub use solver::{Method, SolidTeeth, SolverSpec};

//! Building blocks of effects: their declaration (`effect`), forces on bodies (`body_effect`, `element`), dry friction
//! with sticking (`rubbing_surface`, `friction`, `dry_friction`), and changes to single teeth (`teeth`).

pub mod actuator;
pub mod body_effect;
pub mod body_friction;
pub mod dry_friction;
#[cfg(test)]
#[path = "tests/dry_friction.rs"]
mod dry_friction_tests;
pub mod effect;
pub mod element;
#[cfg(test)]
#[path = "tests/element.rs"]
pub mod element_tests;
pub mod friction;
pub mod friction_state;
pub mod lash_spring;
pub mod loss;
pub mod memory;
pub mod pv_limit;
pub mod ramps;
pub mod rubbing_surface;
pub mod slip_law;
pub mod slip_spec;
pub mod teeth;
pub mod torque_curve;

pub use actuator::{Actuates, Actuator, ActuatorState, Parabola};
pub use body_effect::{Action, BodyEffect, BodyMotion, Slopes, StaticLoads};
pub(super) use effect::readings;
pub use effect::{
    Attached, BUILT, Changes, Class, Declare, Effect, EffectSetting, Heat, InputField, Instant, Needs, Reading,
    Refinement, Warmed,
};
pub use element::{Element, Law, Part, Spring};
pub use friction::Friction;
pub use friction_state::{FrictionState, Mode, PairFriction};
pub use lash_spring::LashSpring;
pub use loss::Loss;
pub use memory::{Memory, Remembered};
pub use pv_limit::PvLimit;
pub use ramps::Ramps;
pub use rubbing_surface::{
    ActingSurface, ByLoad, Command, RubbingSurface, Slip, SurfaceLoad, SurfaceTemperature, ThrustPart,
};
pub use slip_law::SlipLaw;
pub(super) use slip_spec::check_slip;
pub use slip_spec::{Slides, SlipSpec, depends_on_speed, depends_on_temperature};
pub use teeth::{FlankFriction, ToothEffects};
pub use torque_curve::TorqueCurve;

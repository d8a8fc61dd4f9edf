//! Declaration of an effect: its parameters, interface rows, heat and readings, and its actions in a scene.

use std::any::Any;
use std::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Actuator, BodyEffect, BodyMotion, FlankFriction, RubbingSurface, ToothEffects};
use crate::contact::ContactSpec;
use crate::contact::errors::GearTeeth;
use crate::declaration::{Condition, DisplayUnit, EnumType, Group, Need, Row, Rows, Unit};
use crate::geometry::{GearSpec, Pair};
use crate::model::scene::{GearContact, InertiaSpec, Inputs, Material, OilSpec, Plan, Requests, Scene};
use crate::problem::Problem;

/// True if this build contains effects. A build without them proves that an effect that is off costs nothing.
pub const BUILT: bool = cfg!(feature = "effects");

/// Access to an input.
pub type InputField = fn(&mut Inputs) -> &mut f64;

/// Heat of an effect: one output, which several effects may share.
#[derive(Clone, Copy, Debug)]
pub struct Heat {
    /// Name of the output.
    pub output: &'static str,
    /// Description in the interface.
    pub description: &'static str,
    /// Part that it warms.
    pub warms: Warmed,
}

/// Part that a heat warms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Warmed {
    /// Node of the thermal network.
    Node(usize),
    /// Shafts outside the housing, which are not in the thermal network.
    Shafts,
    /// Wheels, which are not in the thermal network either. They are beyond the point where `power.out` is counted.
    Wheels,
}

/// Body that an effect attaches to another body: its names in messages and in the interface.
#[derive(Clone, Copy, Debug)]
pub struct Attached {
    /// Name in messages.
    pub name: &'static str,
    /// Prefix of the names of its states.
    pub of: &'static str,
    /// Names of its position and its velocity, after the prefix.
    pub states: [&'static str; 2],
    /// Descriptions of its position and its velocity in the interface.
    pub descriptions: [&'static str; 2],
}

impl Attached {
    /// A body without names.
    pub const NONE: Self = Self { name: "", of: "", states: [""; 2], descriptions: [""; 2] };
}

/// Times at which a reading changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Changes {
    /// At any instant, because the reading follows from the state.
    Always,
    /// At the end of accepted steps, because the reading is part of the ledger.
    ByStep,
}

/// An output of an effect.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    /// Name of the output.
    pub name: &'static str,
    /// Unit.
    pub unit: Unit,
    /// Unit in which it is displayed.
    pub display: Option<DisplayUnit>,
    /// Times at which the reading changes.
    pub changes: Changes,
    /// Type of a reading that is one of several choices.
    pub choices: Option<&'static EnumType>,
    /// Value at an instant, from the parameters of the effect; `None` if the program computes it together with others.
    pub read: Option<fn(&dyn Any, &Instant) -> f64>,
    /// Description in the interface.
    pub description: &'static str,
}

/// Readings of an effect. The doc comment is the description; the unit, the display unit and the changes follow. A
/// reading with `Always(|effect, at| …)` has the value of this function of the effect and the instant. A reading with a
/// type at the end of its line is one of the choices of this type.
macro_rules! readings {
    (@option) => { None };
    (@option $value:expr) => { Some($value) };
    ($($(#[doc = $line:literal])+ $name:literal: $unit:ident $(| $display:ident)?, $changes:ident $(($read:expr))? $(, $choices:ty)?;)+) => {
        &[$($crate::model::effect_kinds::Reading {
            name: $name,
            unit: $unit,
            display: readings!(@option $($display)?),
            changes: $crate::model::effect_kinds::Changes::$changes,
            choices: readings!(@option $(<$choices as $crate::spec::Choices>::TYPE)?),
            read: readings!(@option $(|effect, at| {
                let read: fn(&Self, &$crate::model::effect_kinds::Instant) -> f64 = $read;
                effect.downcast_ref().map_or(0.0, |effect| read(effect, at))
            })?),
            description: concat!($($line),+).split_at(1).1,
        }),+]
    };
}

pub(in crate::model) use readings;

/// Meaning of an effect for a user who asks how accurate a model must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// It says what is built in, broken or driven, so it is part of the question.
    Machine,
    /// It makes the model more accurate.
    Refinement,
    /// It changes no motion and only adds outputs.
    Outputs,
}

/// A part of an effect's model that a plainer model leaves out.
#[derive(Clone, Copy, Debug)]
pub struct Refinement {
    /// Name in messages.
    pub name: &'static str,
    /// Parameters with their values in SI units in the plainer model. The refinement acts if another value acts.
    pub plain: &'static [(&'static str, f64)],
}

/// Representations of tooth contact that an effect needs.
#[derive(Clone, Copy, Debug)]
pub struct Needs {
    /// Representations with which the effect works.
    pub contacts: &'static [GearContact],
    /// Reason why the effect needs them, as a clause for messages.
    pub why: &'static str,
}

/// Scene data from which effects are set up.
#[derive(Clone, Copy)]
pub struct EffectSetting<'a> {
    /// Drives and representation.
    pub scene: &'a Scene,
    /// Given data of the gears.
    pub geometry: &'a GearSpec,
    /// Gear pair that follows from `geometry`.
    pub pair: &'a Pair,
    /// Material.
    pub material: &'a Material,
    /// Oil.
    pub oil: &'a OilSpec,
    /// Inertias.
    pub inertia: &'a InertiaSpec,
    /// Contact law.
    pub contact: &'a ContactSpec,
    /// Teeth of all gears, if they are given individually.
    pub teeth: Option<&'a [GearTeeth]>,
    /// True if the effect is switched on.
    pub on: bool,
    /// Index of the effect's heat in the ledger.
    pub heat_index: usize,
    /// Index of the effect's first body among all attached bodies.
    pub body_index: usize,
}

/// Scene and motion at an instant, from which readings follow.
#[derive(Clone, Copy)]
pub struct Instant<'a> {
    /// True if the effect is switched on.
    pub on: bool,
    /// Plan of the scene.
    pub plan: &'a Plan,
    /// Motion and inputs.
    pub motion: &'a BodyMotion<'a>,
    /// Torques that the half-shafts deliver to the wheels, left and right [N·m].
    pub shaft_torque: [f64; 2],
    /// Torque on the carrier from its drive [N·m].
    pub carrier_torque: f64,
    /// Torques of the clutches on the side gears, left and right [N·m].
    pub clutch_torque: [f64; 2],
}

/// Declaration of an effect. It is implemented by the struct of the effect's parameters.
pub trait Declare: Group + Rows + Debug + Default + PartialEq + Serialize + DeserializeOwned {
    /// Description of its switch in the interface.
    const DESCRIPTION: &'static str;
    /// Heat in the ledger; `None` if the effect dissipates nothing.
    const HEAT: Option<Heat> = None;
    /// Outputs in addition to the heat.
    const READINGS: &'static [Reading] = &[];
    /// Bodies that it may attach.
    const BODIES: &'static [Attached] = &[];
    /// Representations of tooth contact that the effect needs. With `None`, it works with all of them.
    const NEEDS: Option<Needs> = None;
    /// Switch of another effect without which this effect cannot act.
    const NEEDS_EFFECT: Option<&'static str> = None;
    /// Its meaning for a user who asks how accurate a model must be.
    const CLASS: Class = Class::Refinement;
    /// Parts of its model that a plainer model leaves out.
    const REFINEMENTS: &'static [Refinement] = &[];
    /// True if the effect may act although its switch is off.
    const MAY_ACT_UNSWITCHED: bool = false;
    /// True if it is friction that differs with the sense of rolling, and so biases the torque.
    const BIASES_TORQUE: bool = false;
    /// Name of its limit of p·v, if it has one. Its first reading that changes at any instant is then the p·v.
    const PV_LIMIT: Option<&'static str> = None;
    /// True if it records steps.
    const RECORDS_STEPS: bool = false;
    /// Values that make the effect visible in an example: names of variables with values in SI units.
    const EXAMPLE: &'static [(&'static str, f64)] = &[];

    /// Condition under which its switch has any influence; `None` means always.
    fn when() -> Option<Condition> {
        None
    }

    /// Influences on shared parameters, with the condition under which the effect has each.
    fn needs() -> Vec<(Need, Condition)> {
        Vec::new()
    }

    /// Rows of its inputs.
    fn inputs() -> Vec<Row<InputField>> {
        Vec::new()
    }
}

/// Actions of an effect in a scene.
pub trait Effect: Any {
    /// Adds the problems of its parameters to `found`.
    fn check(&self, _setting: &EffectSetting, _found: &mut Vec<Problem>) {}

    /// Warnings about unusual parameters.
    fn warnings(&self, _setting: &EffectSetting) -> Vec<Problem> {
        Vec::new()
    }

    /// Degrees of freedom that the effect requires.
    fn requests(&self, _setting: &EffectSetting) -> Requests {
        Requests::default()
    }

    /// Adds the effect's influence on single teeth to `teeth`. Fails if its parameters contradict the gears.
    fn on_teeth(&self, _setting: &EffectSetting, _teeth: &mut ToothEffects) -> Result<(), Problem> {
        Ok(())
    }

    /// Friction along the flanks, if the effect adds any.
    fn on_flanks(&self, _setting: &EffectSetting) -> Option<FlankFriction> {
        None
    }

    /// Forces and torques on bodies other than dry friction, if the effect adds any.
    fn on_bodies(&self, _setting: &EffectSetting, _plan: &Plan) -> Option<Box<dyn BodyEffect>> {
        None
    }

    /// True if the effect depends on the viscosity of the oil at its temperature.
    fn is_oiled(&self) -> bool {
        false
    }

    /// Actuator of its commands, and their indices in the order of [`Inputs::actuated`].
    fn actuator(&self) -> Option<(Actuator, &'static [usize])> {
        None
    }

    /// Adds the surfaces on which the effect lets bodies rub to `surfaces`.
    fn add_surfaces(&self, _setting: &EffectSetting, _surfaces: &mut Vec<RubbingSurface>) {}
}

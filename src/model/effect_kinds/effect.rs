//! What an effect declares: its parameters, its rows of the interface, its heat, its readings, and what it does.

use std::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{BodyEffect, BodyMotion, FlankFriction, FrictionSource, ToothEffects};
use crate::contact::ContactSpec;
use crate::contact::errors::GearTeeth;
use crate::declaration::units::{W_PER_M2, W_PER_MM2};
use crate::declaration::{DisplayUnit, Parameter, Row, Unit};
use crate::geometry::{GearSpec, Pair};
use crate::model::scene::{GearContact, InertiaSpec, Inputs, Material, OilSpec, Plan, Requests, Scene};
use crate::problem::Problem;

/// Whether this build has effects at all; one without proves that an effect that is off costs nothing.
pub const BUILT: bool = cfg!(feature = "effects");

/// Access to an input.
pub type InputField = fn(&mut Inputs) -> &mut f64;

/// Heat of an effect: one output, which several effects may share.
#[derive(Clone, Copy, Debug)]
pub struct Heat {
    /// Name of the output.
    pub output: &'static str,
    /// What it is.
    pub description: &'static str,
    /// Whether it arises at the wheels, beyond the torque that `power.out` counts.
    pub at_wheels: bool,
}

/// When a reading changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Changes {
    /// At any instant: it follows from the state.
    Always,
    /// With accepted steps: it is part of the ledger.
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
    /// When it changes.
    pub changes: Changes,
    /// What it is.
    pub description: &'static str,
}

/// The output of a friction's p·v.
pub const fn pv_reading(name: &'static str, description: &'static str) -> Reading {
    Reading { name, unit: W_PER_M2, display: Some(W_PER_MM2), changes: Changes::Always, description }
}

/// Representations of tooth contact that an effect needs.
#[derive(Clone, Copy, Debug)]
pub struct Needs {
    /// Those it works with.
    pub contacts: &'static [GearContact],
    /// Why.
    pub why: &'static str,
}

/// What effects see of a scene when they are set up.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// Drives and representation.
    pub scene: &'a Scene,
    /// Gears as given,
    pub geometry: &'a GearSpec,
    /// and as they follow from it.
    pub pair: &'a Pair,
    /// Material.
    pub material: &'a Material,
    /// Oil.
    pub oil: &'a OilSpec,
    /// Inertias.
    pub inertia: &'a InertiaSpec,
    /// Contact law.
    pub contact: &'a ContactSpec,
    /// Teeth of all gears, where they are given one by one.
    pub teeth: Option<&'a [GearTeeth]>,
    /// Whether the effect is switched on.
    pub on: bool,
    /// Index of the effect's heat in the ledger.
    pub heat_index: usize,
}

/// What readings follow from.
#[derive(Clone, Copy)]
pub struct Instant<'a> {
    /// Whether the effect is switched on.
    pub on: bool,
    /// Plan of the scene.
    pub plan: &'a Plan,
    /// Motion and inputs.
    pub motion: &'a BodyMotion<'a>,
    /// Torques that the half-shafts deliver to the wheels, left and right [N·m].
    pub shaft_torque: [f64; 2],
}

/// What an effect declares. The type that declares is the struct of its parameters; its `Default` are their start values.
pub trait Declare: Copy + Debug + Default + PartialEq + Serialize + DeserializeOwned {
    /// What its switch switches.
    const DESCRIPTION: &'static str;
    /// Its heat.
    const HEAT: Option<Heat> = None;
    /// Its own outputs.
    const READINGS: &'static [Reading] = &[];
    /// Representations of tooth contact it needs; `None` works with all.
    const NEEDS: Option<Needs> = None;
    /// Whether it may act although its switch is off.
    const MAY_ACT_UNSWITCHED: bool = false;
    /// Condition under which a scene can feel its switch, as of a row; none: always.
    const WHEN: Option<&'static str> = None;
    /// Values that make it visible in an example: names of variables, values in SI.
    const EXAMPLE: &'static [(&'static str, f64)] = &[];

    /// Start values of its parameters.
    fn start() -> Self {
        Self::default()
    }

    /// Rows of its parameters.
    fn parameters() -> Vec<Row<Parameter<Self>>>;

    /// Rows of its inputs.
    fn inputs() -> Vec<Row<InputField>> {
        Vec::new()
    }
}

/// What an effect does in a scene.
pub trait Effect {
    /// Adds what is wrong with its parameters.
    fn check(&self, _setting: &Setting, _found: &mut Vec<Problem>) {}

    /// What is unusual about it.
    fn warnings(&self, _setting: &Setting) -> Vec<Problem> {
        Vec::new()
    }

    /// Degrees of freedom it requires.
    fn requests(&self, _setting: &Setting) -> Requests {
        Requests::default()
    }

    /// Sets up what it does to single teeth.
    fn on_teeth(&self, _setting: &Setting, _teeth: &mut ToothEffects) -> Result<(), Problem> {
        Ok(())
    }

    /// Friction along the flanks.
    fn on_flanks(&self, _setting: &Setting) -> Option<FlankFriction> {
        None
    }

    /// Forces and torques on bodies, other than dry friction.
    fn on_bodies(&self, _setting: &Setting, _plan: &Plan) -> Option<Box<dyn BodyEffect>> {
        None
    }

    /// Whether it depends on the viscosity of the oil at its temperature.
    fn is_oiled(&self) -> bool {
        false
    }

    /// Dry friction.
    fn friction(&self, _setting: &Setting) -> Option<FrictionSource> {
        None
    }

    /// Sets its readings that change at any instant.
    fn read(&self, _at: &Instant, _out: &mut [f64]) {}
}

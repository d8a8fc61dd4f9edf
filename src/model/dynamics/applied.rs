//! Inputs behind their actuators, dry friction, dog clutches and oil, which act in the equations in addition to the gears.

use super::actuated::courses;
use super::{Actuated, State};
use crate::model::assembly::BodyEffects;
use crate::model::effect_kinds::actuator::moved;
use crate::model::effect_kinds::{Friction, FrictionState, Parabola};
use crate::model::scene::{ACTUATED, Dogs, InputDerivatives, Inputs, PAIRS, Viscosity};
use crate::model::thermal::NODES;

/// Inputs and dry friction that act in the equations.
#[derive(Clone, Copy)]
pub struct InputsAndFriction {
    /// Inputs. Commands that pass actuators have the values that act behind these.
    pub inputs: Inputs,
    /// Derivatives of the inputs.
    pub input_derivatives: InputDerivatives,
    /// Actuators that move, and the courses of their commands.
    actuated: Option<(Actuated, [Parabola; ACTUATED])>,
    /// True if inputs change with time.
    pub driven: bool,
    /// Changes of the load torques, left and right, and of the drive's torque within the pending step [N·m].
    pub change: [f64; 3],
    /// State of the dry friction.
    pub friction_state: [FrictionState; PAIRS],
    friction: Option<Friction>,
    /// True if there is any dry friction.
    pub has_dry_friction: bool,
    /// State of the dog clutches.
    pub dogs: Dogs,
    /// Viscosity of the oil, if an effect needs it.
    pub oil_viscosity: Option<Viscosity>,
}

impl InputsAndFriction {
    /// Inputs that act at `state`. Always inlined, so that this large value is written in place.
    #[inline(always)]
    pub fn without_friction(inputs: &Inputs, state: &State) -> Self {
        Self {
            inputs: *inputs,
            input_derivatives: state.inputs.derivatives.unwrap_or(InputDerivatives::ZERO),
            actuated: None,
            driven: state.inputs.derivatives.is_some(),
            change: [0.0; 3],
            friction_state: state.friction,
            friction: None,
            has_dry_friction: false,
            dogs: state.dogs,
            oil_viscosity: None,
        }
    }

    /// Adds the contribution of effects on bodies at `state`: dry friction, if there may be any, and the viscosity of
    /// the oil.
    pub fn add(&mut self, body_effects: &BodyEffects, state: &State) {
        self.oil_viscosity = body_effects.oil_viscosity(&state.sums.thermal.used);
        if let Some(actuated) = &state.inputs.actuated {
            self.actuate(body_effects, actuated, state);
        }
        if body_effects.may_have_dry_friction(state) {
            let friction = self.friction_at(body_effects, (state.lock, &state.sums.thermal.used));
            self.has_dry_friction = friction.is_any();
            self.friction = Some(friction);
        }
    }

    /// Lets the commands of `state` pass the actuators of the scene.
    #[cold]
    #[inline(never)]
    fn actuate(&mut self, body_effects: &BodyEffects, actuated: &Actuated, state: &State) {
        let actuators = &body_effects.actuators;
        let present = actuated.at(actuators, [&state.inputs.values, &self.inputs], state.time());
        let commands = courses(&self.inputs, state.inputs.derivatives.as_ref());
        if present.moves(actuators, &commands) {
            self.actuated = Some((present, commands));
            self.driven = true;
        }
        present.act(actuators, &commands, &mut self.inputs, &mut self.input_derivatives);
    }

    /// Dry friction with the lock at `lock` and all nodes at `temperatures` [K].
    fn friction_at(&self, body_effects: &BodyEffects, at: (f64, &[f64; NODES])) -> Friction {
        let mut derivatives = self.input_derivatives;
        if self.actuated.is_some() {
            // any value but 0 says that a command changes, even if it starts with derivatives of 0
            derivatives.rates[1].actuated_mut().into_iter().for_each(|rate| *rate = 1.0);
        }
        body_effects.friction(at, &self.inputs, &derivatives)
    }

    /// Inputs and their derivatives `time` [s] later.
    pub fn inputs_after(&self, body_effects: Option<&BodyEffects>, time: f64) -> (Inputs, InputDerivatives) {
        let (mut inputs, mut derivatives) = self.input_derivatives.after(time, &self.inputs);
        if let (Some((actuated, commands)), Some(BodyEffects { actuators, .. })) = (&self.actuated, body_effects) {
            let later = commands.each_ref().map(|command| moved(command, time));
            actuated.after(actuators, commands, time).act(actuators, &later, &mut inputs, &mut derivatives);
        }
        (inputs, derivatives)
    }

    /// True if actuators move.
    pub fn has_moving_actuators(&self) -> bool {
        self.actuated.is_some()
    }

    /// True if dry friction neither acts nor holds anything.
    pub fn is_free(&self) -> bool {
        self.friction.is_none()
    }

    /// Updates dry friction and oil viscosity to other `temperatures` [K].
    pub fn update_temperatures(&mut self, body_effects: &BodyEffects, lock: f64, temperatures: &[f64; NODES]) {
        self.friction = Some(self.friction_at(body_effects, (lock, temperatures)));
        self.oil_viscosity = body_effects.oil_viscosity(temperatures);
    }

    /// Anchors of the springs of dry friction.
    pub fn anchors(&self) -> [f64; PAIRS] {
        self.friction_state.map(|state| state.anchor)
    }

    /// Sets the anchors of the springs of dry friction.
    pub fn set_anchors(&mut self, anchors: &[f64; PAIRS]) {
        self.friction_state.iter_mut().zip(anchors).for_each(|(state, &anchor)| state.anchor = anchor);
    }

    /// Dry friction on all bodies.
    #[inline]
    pub fn friction(&self) -> &Friction {
        self.friction.as_ref().unwrap_or(&Friction::NONE)
    }
}

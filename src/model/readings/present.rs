//! Simulation as its outputs show it: under the present inputs, which the next step will apply.

use crate::model::dynamics::State;
use crate::model::run::events::{has_commanded, with_commanded};
use crate::model::run::progress::complete;
use crate::model::run::{Simulation, imposed};
use crate::model::scene::Inputs;

impl Simulation {
    /// Returns the simulation with its inputs applied, or `None` if this changes nothing. Speeds follow commands that
    /// were set since the last step, and brakes follow their torques. The step itself begins with this change and
    /// records its work.
    pub fn with_inputs_applied(&self) -> Option<Self> {
        let is_met = imposed::are_met(&self.model, &self.inputs, &self.state);
        // with a solver of the host, friction changes only at events
        let may_brake = !self.is_model_exchange() && has_commanded(&self.model);
        if is_met && !may_brake {
            return None;
        }
        let mut state = self.state;
        if !is_met {
            imposed::follow_commands(&self.model, &self.inputs, &mut state);
        }
        let braked = if may_brake { with_commanded(&self.model, &self.inputs, &state) } else { None };
        if is_met && braked.is_none() {
            return None;
        }
        Some(Self { state: braked.unwrap_or(state), forces: None, ..self.clone() })
    }

    /// Returns the simulation with the brakes and clutches applied whose inputs change from 0 in the direction `change`,
    /// or `None` if there are none. Their inputs are the smallest positive number. With a solver of the host, they are
    /// applied only at events.
    pub fn with_friction_applied(&self, change: &Inputs) -> Option<Self> {
        let mut inputs = self.inputs;
        let changes = change.friction_commands().into_iter().flatten();
        for (command, change) in inputs.friction_commands_mut().into_iter().flatten().zip(changes) {
            if *command == 0.0 && change != 0.0 {
                *command = f64::MIN_POSITIVE;
            }
        }
        if inputs == self.inputs || self.is_model_exchange() || !has_commanded(&self.model) {
            return None;
        }
        let state = with_commanded(&self.model, &inputs, &self.state)?;
        Some(Self { state, inputs, forces: None, ..self.clone() })
    }

    /// Returns the simulation as its outputs show it, or `None` if it does not differ: with its inputs applied, and
    /// with temperatures and means over mesh cycles up to the present. Friction changes only with completed steps.
    pub fn shown(&self) -> Option<Self> {
        let mut shown = self.with_inputs_applied();
        if (self.model.layout.has_ends() || self.model.thermal.is_some()) && self.state.pending_step.is_some() {
            let mut completed = self.state;
            complete(&self.model, (&mut completed, None));
            let state = &mut shown.get_or_insert_with(|| self.clone()).state;
            state.torque_means = completed.torque_means;
            state.thermal.rises = completed.thermal.rises;
        }
        shown
    }

    /// Reads the state and the memories with the pending step completed up to the present. The simulation itself
    /// is unchanged.
    pub(in crate::model) fn read_completed<T>(&mut self, read: impl FnOnce(&Self, &State) -> T) -> T {
        let mut state = self.state;
        let checkpoint = self.memories.checkpoint();
        complete(&self.model, (&mut state, Some(&mut self.memories)));
        let found = read(self, &state);
        self.memories.roll_back(checkpoint);
        found
    }
}

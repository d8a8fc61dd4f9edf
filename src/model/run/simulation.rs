//! A running simulation: constants of the model, state and inputs, and the calls that advance them.

use std::sync::Arc;

use crate::FULL;

use super::accepted::Accepted;
use super::interval::RESOLUTION;
use super::moving_inputs::inputs_move;
use super::{StepFailure, watching};
use crate::model::assembly::{Gears, Given, Model};
use crate::model::dynamics::State;
use crate::model::dynamics::event::{AdvanceOptions, Events};
use crate::model::effects::Memories;
use crate::model::outputs::forces::Forces;
use crate::model::scene::{InputDerivatives, Inputs, Method};
use crate::model::setup::Parameters;
use crate::model::thermal::Thermal;
use crate::problem::Problem;

/// A simulation. A clone is a snapshot: it shares the constants and copies the state.
#[derive(Clone, Debug)]
pub struct Simulation {
    pub(in crate::model) model: Arc<Model>,
    pub(in crate::model) state: State,
    /// Memories of the effects that are on.
    pub(in crate::model) memories: Memories,
    /// Inputs that the host has set. They act from the next step on.
    pub(in crate::model) inputs: Inputs,
    /// Cache of the forces under the present inputs; `None` after a change.
    pub(in crate::model) forces: Option<Forces>,
    /// End of the last step that the host's solver completed, in model exchange.
    pub(in crate::model) accepted: Option<Accepted>,
}

impl Simulation {
    /// Simulation of `parameters` that continues from `state`, without earlier memories. Fails with all problems
    /// of the parameters.
    pub fn resume(parameters: &Parameters, inputs: &Inputs, state: State) -> Result<Self, Vec<Problem>> {
        Self::resume_with(parameters, inputs, (state, None), &Given::default())
    }

    /// Simulation of `parameters` that continues from `state`, with the `memories`, or without earlier ones. `given`
    /// contains optional data. Fails with all problems of the parameters, or if a memory belongs to another scene.
    pub fn resume_with(
        parameters: &Parameters,
        inputs: &Inputs,
        (state, memories): (State, Option<Memories>),
        given: &Given,
    ) -> Result<Self, Vec<Problem>> {
        let model = Arc::new(Model::new(parameters, given)?);
        let start = watching::at_start(&model, state.time(), true);
        let memories = memories.unwrap_or_else(|| start.clone());
        if let Some(effect) = memories.misfit(&start) {
            return Err(vec![Problem::new(effect, "its saved memory belongs to another scene")]);
        }
        let mut inputs = *inputs;
        model.ideal.plan.refer(&mut inputs);
        Ok(Self { model, state, memories, inputs, forces: None, accepted: None })
    }

    /// Sets the inputs of the next step.
    pub fn set_inputs(&mut self, inputs: &Inputs) {
        let Inputs { drive_speed, drive_torque, .. } = self.inputs;
        // the inputs of the drive follow from the others
        if self.inputs != (Inputs { drive_speed, drive_torque, ..*inputs }) {
            self.inputs = *inputs;
            self.model.ideal.plan.refer(&mut self.inputs);
            self.forces = None;
        }
    }

    /// Inputs that the host has set for the next step.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Sets the derivatives of the inputs. Without derivatives, inputs are constant.
    pub fn set_input_derivatives(&mut self, input_derivatives: Option<InputDerivatives>) {
        self.share_input_derivatives(input_derivatives.as_ref());
    }

    /// Copies `input_derivatives` to the derivatives of the inputs.
    #[inline]
    pub fn share_input_derivatives(&mut self, input_derivatives: Option<&InputDerivatives>) {
        if input_derivatives.is_none() && self.state.inputs.derivatives.is_none() {
            return;
        }
        let derivatives = input_derivatives.map(|given| self.model.ideal.plan.with_drive(*given));
        if derivatives != self.state.inputs.derivatives {
            self.state.inputs.derivatives = derivatives;
            self.state.timeline.pause = None;
            self.forces = None;
        }
    }

    /// Derivatives of the inputs, if they are set.
    pub fn input_derivatives(&self) -> Option<&InputDerivatives> {
        self.state.inputs.derivatives.as_ref()
    }

    /// Applies changed tunable parameters.
    pub fn tune(&mut self, parameters: &Parameters) {
        self.complete_pending();
        Arc::make_mut(&mut self.model).tune(parameters);
        if self.model.thermal.is_none() {
            self.state.sums.thermal = Thermal::uniform(parameters.oil.temperature);
        }
        // the next step restarts the integration under the new parameters
        self.state.control.discontinuity(None);
        self.state.timeline.pause = None;
        self.memories.tuned();
        self.forces = None;
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.state.time()
    }

    /// Last events.
    pub fn events(&self) -> &Events {
        &self.state.events
    }

    /// Returns the end [s] of the solver step that contains the present or starts there. Returns `None` if solver steps
    /// end at the times that the host requests. Fails if no step can start.
    pub fn next_solver_time(&mut self) -> Result<Option<f64>, StepFailure> {
        let (model, state) = (&self.model, &self.state);
        let is_closed = matches!(&model.gears, Gears::Ideal(ideal) if !ideal.body_effects.act_in(state));
        if is_closed || inputs_move(model, state) || model.parameters.solver.method == Method::FixedStep {
            return Ok(None);
        }
        let end = |state: &State| {
            let step = state.pending_step.as_ref()?;
            let last = state.timeline.last_communication_point(&step.clock);
            Some(last.time + (step.end() - last.clock)).filter(|&end| end > state.time())
        };
        let holds = self.state.pending_step.is_some() && self.state.inputs.values == self.inputs;
        if let (true, Some(end)) = (holds, end(&self.state)) {
            return Ok(Some(end));
        }
        // advancing by the smallest distinguishable time starts the step
        let time = self.state.time();
        let until = time.next_up().max(time + 2.0 * RESOLUTION);
        self.advance_by(until, AdvanceOptions { is_part: true, ..AdvanceOptions::default() })?;
        Ok(end(&self.state))
    }

    /// True if the host's solver integrates the states.
    pub fn is_model_exchange(&self) -> bool {
        FULL && self.accepted.is_some()
    }

    /// End of the last step that the host's solver completed, for snapshots; `None` in co-simulation.
    pub fn accepted(&self) -> Option<&Accepted> {
        self.accepted.as_ref()
    }

    /// Returns the simulation with `accepted` as the end of the last step that the host's solver completed.
    pub fn from_accepted(self, accepted: Option<Accepted>) -> Self {
        Self { accepted, ..self }
    }

    /// State, for snapshots.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Memories of the effects that are on, for snapshots.
    pub fn memories(&self) -> &Memories {
        &self.memories
    }
}

//! A running simulation: constants of the model, state and inputs, and the calls that advance them.

use std::sync::Arc;

use crate::FULL;

use super::accepted::Accepted;
use super::events::next_change;
use super::integration::RESOLUTION;
use super::progress::{self, restart};
use super::{StepFailure, change, watching};
use crate::model::assembly::{Gears, Given, Model};
use crate::model::dynamics::event::{AdvanceOptions, Events};
use crate::model::dynamics::timeline::resolution;
use crate::model::dynamics::{CommunicationPoint, State};
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

/// Effect of the inputs on the integration at the start of a step.
#[derive(Clone, Copy, PartialEq)]
enum Beginning {
    /// The inputs have not changed.
    None,
    /// Only torques have changed, which causes no event. The pending step is completed up to the change, and the
    /// integration continues. The value is the change of the accelerations [rad/s²].
    Torques(f64),
    /// The integration restarts without an event.
    Silent,
    /// The integration restarts with an event.
    Event,
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
            InputDerivatives::copy(derivatives.as_ref(), &mut self.state.inputs.derivatives);
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
        progress::complete(&self.model, (&mut self.state, Some(&mut self.memories)));
        Arc::make_mut(&mut self.model).tune(parameters);
        if self.model.thermal.is_none() {
            self.state.thermal = Thermal::uniform(parameters.oil.temperature);
        }
        // the next step restarts the integration under the new parameters
        self.state.control.discontinuity(None);
        self.state.timeline.pause = None;
        self.memories.tuned();
        self.forces = None;
    }

    /// Integrates to `until` [s]. Inputs follow their derivatives. After a failure, the simulation is at the last good
    /// time.
    pub fn advance(&mut self, until: f64) -> Result<(), StepFailure> {
        self.advance_by(until, AdvanceOptions::default())
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.state.time()
    }

    /// Last events.
    pub fn events(&self) -> &Events {
        &self.state.events
    }

    /// Applies changed inputs at the present time, as the next step would at its start. Returns true if this causes an
    /// event. The next step continues from here, with the same bits as if it had applied the inputs itself.
    pub fn begin(&mut self) -> bool {
        self.begin_step() == Beginning::Event
    }

    #[inline(always)]
    fn begin_step(&mut self) -> Beginning {
        if self.inputs_act() { Beginning::None } else { self.begin_under_inputs() }
    }

    /// True if the inputs already act.
    fn inputs_act(&self) -> bool {
        let State { inputs, timeline, pending_step, .. } = &self.state;
        let has_begun = if pending_step.is_some() { inputs.derivatives.is_none() } else { timeline.pause.is_some() };
        has_begun && inputs.values == self.inputs
    }

    fn begin_under_inputs(&mut self) -> Beginning {
        let Self { model, state, memories, inputs, .. } = self;
        if let Some(acceleration_change) = change::torque_change_within(model, inputs, state) {
            return Beginning::Torques(acceleration_change);
        }
        let count = state.events.count();
        restart(model, inputs, (state, memories));
        state.timeline.pause = Some(CommunicationPoint { clock: 0.0, time: state.time() });
        self.forces = None;
        if state.events.count() == count { Beginning::Silent } else { Beginning::Event }
    }

    /// Integrates to `until` [s], or to the first event if `options.pauses`. If `options.is_part`, `until` precedes the
    /// next communication point. The next call continues with the same bits as without the stop. An event at the start
    /// (see [`Self::begin`]) does not pause the motion. Fails if a step cannot be completed; the simulation is then at
    /// the last good time.
    #[inline]
    pub fn advance_by(&mut self, until: f64, options: AdvanceOptions) -> Result<(), StepFailure> {
        if self.records_exchange() {
            return self.advance_recorded(until, options);
        }
        self.advance_unrecorded(until, options)
    }

    /// Advances as [`Self::advance_by`] does, without a record of the exchange with the host.
    pub(super) fn advance_unrecorded(&mut self, until: f64, options: AdvanceOptions) -> Result<(), StepFailure> {
        self.forces = None;
        let beginning = self.begin_step();
        let Self { model, state, memories, inputs, .. } = self;
        let model = &**model;
        let acceleration_change = match beginning {
            Beginning::Torques(change) => Some(change),
            _ => None,
        };
        // the pending step may already contain the requested time
        let continues = state.pending_step.is_some() && acceleration_change.is_none();
        let change = if continues { next_change(model, state) } else { None };
        let is_before_change = change.is_none_or(|change| until + resolution(change) < change);
        if continues && is_before_change && state.move_within(until, options.is_part, model.layout.count()) {
            progress::wrap_and_constrain(model, state);
            return Ok(());
        }
        // ideal gears without effects have a closed form
        if let Gears::Ideal(ideal) = &model.gears
            && !ideal.body_effects.act_in(state)
        {
            let h = until - state.time();
            let (q, v, work) = (state.q, state.v, state.work);
            match &state.inputs.derivatives {
                None => model.ideal.advance(state, inputs, h),
                Some(derivatives) => {
                    let motions = model.ideal.motion_by_order(inputs, derivatives);
                    model.ideal.advance_along(state, &motions, h);
                }
            }
            if !state.is_motion_finite() {
                (state.q, state.v, state.work) = (q, v, work);
                return Err(StepFailure::not_finite(state.time()));
            }
            if state.inputs.derivatives.is_some() {
                progress::advance_inputs(model, inputs, state, h);
                // exact to the last bit, because the next step would treat any difference as a discontinuity
                model.ideal.impose(state, inputs);
            }
            state.timeline.pause = None;
            progress::arrive_at(state, until, state.time() + h)?;
            state.statistics.accepted += 1;
            state.control.last = h;
            state.wrap(&model.periods, &model.body_effects().pairs);
            return Ok(());
        }
        let before = (*inputs, *state);
        let checkpoint = memories.checkpoint();
        let mut outcome = progress::integrate(model, (inputs, state, memories), (until, options, acceleration_change));
        if outcome.as_ref().is_err_and(|failure| failure.time < before.1.time()) {
            // the pending step cannot be completed: restart at the present, from where another step may succeed
            (*inputs, *state) = before;
            memories.roll_back(checkpoint);
            restart(model, inputs, (state, memories));
            outcome = progress::integrate(model, (inputs, state, memories), (until, options, None));
        }
        if outcome.is_ok() && !state.is_valid_without_pending_step() {
            outcome = Err(StepFailure::not_finite(state.time()));
            (*inputs, *state) = before;
            memories.roll_back(checkpoint);
        }
        outcome
    }

    /// Returns the end [s] of the solver step that contains the present or starts there. Returns `None` if solver steps
    /// end at the times that the host requests. Fails if no step can start.
    pub fn next_solver_time(&mut self) -> Result<Option<f64>, StepFailure> {
        let (model, state) = (&self.model, &self.state);
        let is_closed = matches!(&model.gears, Gears::Ideal(ideal) if !ideal.body_effects.act_in(state));
        if is_closed || progress::inputs_move(model, state) || model.parameters.solver.method == Method::FixedStep {
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

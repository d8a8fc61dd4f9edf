//! A running simulation: parameters → geometry → plan → equations → state.

use std::sync::Arc;

use crate::FULL;

use super::accepted::Accepted;
use super::integration::RESOLUTION;
use super::progress::{self, begin_anew};
use super::watching::Watched;
use super::{StepFailure, change, timeline};
use crate::model::assembly::{Gears, Given, Model};
use crate::model::dynamics::State;
use crate::model::dynamics::event::{Events, Pause, Way};
use crate::model::effects::strength::Fatigue;
use crate::model::outputs::forces::Forces;
use crate::model::scene::{InputDerivatives, Inputs, Method};
use crate::model::setup::Parameters;
use crate::model::thermal::Thermal;
use crate::problem::Problem;

/// A simulation; cloning it takes a snapshot (constants are shared, the state is copied).
#[derive(Clone, Debug)]
pub struct Simulation {
    pub(in crate::model) model: Arc<Model>,
    pub(in crate::model) state: State,
    /// What steps are watched for.
    pub(in crate::model) watched: Watched,
    pub(in crate::model) inputs: Inputs,
    pub(in crate::model) forces: Option<Forces>,
    /// Where the last step ended that a solver of the host's completed.
    pub(in crate::model) accepted: Option<Accepted>,
}

/// What becomes of the inputs at the begin of a step.
#[derive(Clone, Copy, PartialEq)]
enum Beginning {
    /// They have not changed.
    None,
    /// Only torques have changed: the integration completes the step ahead and goes on. No event depends on it. Accelerations jump by
    /// so much [rad/s²].
    Within(f64),
    /// The integration begins anew.
    Silent,
    /// It does, with an event.
    Event,
}

impl Simulation {
    /// A simulation of `parameters` that continues from `state`, with teeth that are not damaged yet and no history.
    pub fn resume(parameters: &Parameters, inputs: &Inputs, state: State) -> Result<Self, Vec<Problem>> {
        let fatigue = Fatigue::new(state.time(), parameters.specs.strength.rate_from, true);
        Self::resume_with(parameters, inputs, (state, Watched { fatigue, ..Watched::default() }), &Given::default())
    }

    /// A simulation of `parameters` that continues from a state and what was watched, with what is `given` besides.
    pub fn resume_with(
        parameters: &Parameters,
        inputs: &Inputs,
        (state, watched): (State, Watched),
        given: &Given,
    ) -> Result<Self, Vec<Problem>> {
        let model = Arc::new(Model::new(parameters, given)?);
        Ok(Self { model, state, watched, inputs: *inputs, forces: None, accepted: None })
    }

    /// Sets the inputs that act from now on.
    pub fn set_inputs(&mut self, inputs: &Inputs) {
        if *inputs != self.inputs {
            self.inputs = *inputs;
            self.forces = None;
        }
    }

    /// The inputs that act now.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Sets the derivatives of the inputs; without any, inputs are constant.
    pub fn set_input_derivatives(&mut self, input_derivatives: Option<InputDerivatives>) {
        self.share_input_derivatives(input_derivatives.as_ref());
    }

    /// Sets the derivatives of the inputs to a copy of these.
    #[inline]
    pub fn share_input_derivatives(&mut self, input_derivatives: Option<&InputDerivatives>) {
        if input_derivatives != self.state.input_derivatives.as_ref() {
            InputDerivatives::copy(input_derivatives, &mut self.state.input_derivatives);
            self.state.pause = None;
            self.forces = None;
        }
    }

    /// Derivatives of the inputs, where they are set.
    pub fn input_derivatives(&self) -> Option<&InputDerivatives> {
        self.state.input_derivatives.as_ref()
    }

    /// Takes over tunable parameters.
    pub fn tune(&mut self, parameters: &Parameters) {
        progress::complete(&self.model, (&mut self.state, &mut self.watched));
        Arc::make_mut(&mut self.model).tune(parameters);
        if self.model.thermal.is_none() {
            self.state.thermal = Thermal::uniform(parameters.oil.temperature);
        }
        // the next step begins again under the new parameters
        self.state.control.jump(None);
        self.state.pause = None;
        self.watched.last_loads = None;
        self.forces = None;
    }

    /// Integrates to `until` [s]; inputs change by their derivatives. On failure the state is that of the last good time.
    pub fn advance(&mut self, until: f64) -> Result<(), StepFailure> {
        self.advance_by(until, Way::default())
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.state.time()
    }

    /// The last events.
    pub fn events(&self) -> &Events {
        &self.state.events
    }

    /// Applies the inputs at the present if they have changed, as the next step would at its start. Returns true if this is an
    /// event. The next step then continues from here, with the same bits as if the step had applied the inputs.
    pub fn begin(&mut self) -> bool {
        self.begin_step() == Beginning::Event
    }

    #[inline(always)]
    fn begin_step(&mut self) -> Beginning {
        if self.inputs_act() { Beginning::None } else { self.begin_under_inputs() }
    }

    /// Whether the inputs act already.
    fn inputs_act(&self) -> bool {
        let Self { state, inputs, .. } = self;
        match &state.pending_step {
            Some(pending_step) => pending_step.inputs == *inputs && state.input_derivatives.is_none(),
            None => state.pause.as_ref().is_some_and(|pause| pause.inputs == *inputs),
        }
    }

    fn begin_under_inputs(&mut self) -> Beginning {
        let Self { model, state, watched, inputs, .. } = self;
        if let Some(jump) = change::jump_within(model, inputs, state) {
            return Beginning::Within(jump);
        }
        let count = state.events.count();
        begin_anew(model, inputs, (state, watched));
        state.pause = Some(Pause { now: 0.0, time: state.time(), inputs: *inputs });
        self.forces = None;
        if state.events.count() == count { Beginning::Silent } else { Beginning::Event }
    }

    /// Integrates to `until` [s], or to the first event if the way `pauses`, or a part of the way to a communication point. The
    /// motion continues from there with the same bits as without a stop. An event at the start, see [`Self::begin`], does not
    /// pause the motion.
    pub fn advance_by(&mut self, until: f64, way: Way) -> Result<(), StepFailure> {
        self.forces = None;
        let beginning = self.begin_step();
        let Self { model, state, watched, inputs, .. } = self;
        let model = &**model;
        let jump = if let Beginning::Within(jump) = beginning { Some(jump) } else { None };
        let leads_on = state.pending_step.is_some() && jump.is_none();
        if leads_on && timeline::move_within(model, state, (until, way)) {
            progress::keep_together(model, state);
            return Ok(());
        }
        if let Gears::Ideal(ideal) = &model.gears
            && !ideal.body_effects.act_in(state)
        {
            let h = until - state.time();
            let (q, v, work) = (state.q, state.v, state.work);
            match &state.input_derivatives {
                None => model.ideal.advance(state, inputs, h),
                Some(derivatives) => {
                    let course = model.ideal.course(inputs, derivatives);
                    model.ideal.advance_along(state, &course, h);
                }
            }
            if !state.is_motion_finite() {
                (state.q, state.v, state.work) = (q, v, work);
                return Err(StepFailure::not_finite(state.time()));
            }
            if state.input_derivatives.is_some() {
                progress::advance_inputs(inputs, state, h);
                // to the last bit, because the next step takes any difference for a jump
                model.ideal.impose(state, inputs);
            }
            state.pause = None;
            timeline::arrive(state, until, state.time() + h)?;
            state.statistics.accepted += 1;
            state.control.last = h;
            state.wrap(&model.periods, &model.layout);
            return Ok(());
        }
        let before = (*inputs, *state);
        // what nothing counts need not be kept
        let saved = model.watch.as_ref().map(|_| Watched { last_loads: None, ..*watched });
        let mut outcome = progress::integrate(model, (inputs, state, watched), (until, way, jump));
        if outcome.as_ref().is_err_and(|failure| failure.time < before.1.time()) {
            // a step that was to lead beyond what has been shown cannot be completed: from here another may
            go_back((inputs, state, watched), &before, &saved);
            begin_anew(model, inputs, (state, watched));
            outcome = progress::integrate(model, (inputs, state, watched), (until, way, None));
        }
        if outcome.is_ok() && !state.is_valid_without_pending_step() {
            outcome = Err(StepFailure::not_finite(state.time()));
            go_back((inputs, state, watched), &before, &saved);
        }
        outcome
    }

    /// Where the solver's step ends that contains the present or begins there [s]; none where the solver's steps end where the host
    /// asks.
    pub fn next_solver_time(&mut self) -> Result<Option<f64>, StepFailure> {
        let (model, state) = (&self.model, &self.state);
        let is_closed = matches!(&model.gears, Gears::Ideal(ideal) if !ideal.body_effects.act_in(state));
        if is_closed || state.input_derivatives.is_some() || model.parameters.solver.method == Method::FixedStep {
            return Ok(None);
        }
        let end = |state: &State| {
            let step = state.pending_step.as_ref()?;
            let [now, time] = timeline::last_communication_point(state, &step.clock);
            Some(time + (step.end() - now)).filter(|&end| end > state.time())
        };
        let holds = self.state.pending_step.as_ref().is_some_and(|step| step.inputs == self.inputs);
        if let (true, Some(end)) = (holds, end(&self.state)) {
            return Ok(Some(end));
        }
        // the least way on that the solver can tell from none begins the step
        let time = self.state.time();
        let until = time.next_up().max(time + 2.0 * RESOLUTION);
        self.advance_by(until, Way { is_part: true, ..Way::default() })?;
        Ok(end(&self.state))
    }

    /// True if a solver of the host integrates the states.
    pub fn is_model_exchange(&self) -> bool {
        FULL && self.accepted.is_some()
    }

    /// Where the host's solver last completed a step, for snapshots.
    pub fn accepted(&self) -> Option<&Accepted> {
        self.accepted.as_ref()
    }

    /// The same simulation with the host's solver last at `accepted`.
    pub fn from_accepted(self, accepted: Option<Accepted>) -> Self {
        Self { accepted, ..self }
    }

    /// The state, for snapshots.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// What steps are watched for, for snapshots.
    pub fn watched(&self) -> &Watched {
        &self.watched
    }
}

/// Takes all that changes back to what it was `before`.
#[cold]
fn go_back(
    (inputs, state, watched): (&mut Inputs, &mut State, &mut Watched),
    before: &(Inputs, State),
    saved: &Option<Watched>,
) {
    (*inputs, *state) = *before;
    if let Some(saved) = saved {
        *watched = *saved;
    }
}

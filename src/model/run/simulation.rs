//! A running simulation: parameters → geometry → plan → equations → state.

use std::sync::Arc;

use super::events::{apply_changes, break_tooth};
use super::integration::RESOLUTION;
use super::progress::{self, begin_anew};
use super::{StepFailure, imposed, timeline};
use crate::model::assembly::{Gears, Given, Model};
use crate::model::dynamics::event::{Events, Pause, Way};
use crate::model::dynamics::{Accepted, Largest, State, Watched};
use crate::model::effects::strength::Fatigue;
use crate::model::outputs::forces::Forces;
use crate::model::scene::{InputDerivatives, Inputs, Method, Start};
use crate::model::setup::{HEATS, Parameters};
use crate::model::start::{preload, report};
use crate::model::thermal::Thermal;
use crate::problem::Problem;

/// First step tried after a start [s]: near the fastest motion of stiff teeth; the controller grows it in a few steps.
const FIRST_STEP: f64 = 1e-6;

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

impl Simulation {
    /// Starts a simulation at `time` [s]; values must be within the ranges of the interface.
    pub fn start(parameters: &Parameters, inputs: &Inputs, time: f64) -> Result<Self, Vec<Problem>> {
        Self::start_with(parameters, inputs, time, &Given::default())
    }

    /// The same with what is `given` besides.
    pub fn start_with(
        parameters: &Parameters,
        inputs: &Inputs,
        time: f64,
        given: &Given,
    ) -> Result<Self, Vec<Problem>> {
        let mut simulation =
            Self::resume_with(parameters, inputs, (State::at_rest(time, FIRST_STEP), Watched::default()), given)?;
        let (model, state) = (&simulation.model, &mut simulation.state);
        let oil = parameters.oil.temperature;
        state.thermal = match &model.thermal {
            Some(network) => {
                let sump = network.around.changed(inputs.changes_outside()).sump;
                Thermal::at(parameters.specs.warm_up.temperatures_at_start(sump.unwrap_or(oil)))
            }
            None => Thermal::uniform(oil),
        };
        preload::set_speeds(model, inputs, state);
        // a tooth that is broken from the start on
        break_tooth(model, inputs, state);
        let mut preloaded = None;
        if parameters.scene.start.is_in_equilibrium() {
            match &model.gears {
                Gears::Ideal(ideal) => preload::wind(model, &ideal.body_effects.half_shafts, inputs, state),
                Gears::Teeth(teeth) => {
                    let equations = Largest::new(teeth, inputs, state);
                    let pressed = preload::preload(&equations, model, inputs, state);
                    preloaded = Some(pressed.map_err(|problem| vec![problem])?);
                }
            }
        }
        imposed::jump(&simulation.model, inputs, &mut simulation.state);
        let events = simulation.state.events;
        apply_changes(&simulation.model, inputs, &mut simulation.state);
        // friction that holds from the start on causes no event
        simulation.state.events = events;
        let mut in_equilibrium = parameters.scene.start.is_in_equilibrium();
        if let Some(preload) = &preloaded {
            let outcome = report::judge(&simulation.model, inputs, &simulation.state, preload);
            in_equilibrium = outcome.in_equilibrium;
            Arc::make_mut(&mut simulation.model).warnings.extend(outcome.warnings);
        }
        if parameters.scene.start == Start::SteadyHeat {
            simulation.begin_with_steady_heat().map_err(|problem| vec![problem])?;
        }
        simulation.state.work = 0.0;
        simulation.state.heat = [0.0; HEATS];
        simulation.state.energy_at_start = simulation.energy(&simulation.state);
        simulation.watched.fatigue = Fatigue::new(time, parameters.specs.strength.rate_from, in_equilibrium);
        Ok(simulation)
    }

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
        if input_derivatives != self.state.input_derivatives {
            self.state.input_derivatives = input_derivatives;
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
        self.state.pause = None;
        self.watched.last_loads = None;
        self.forces = None;
    }

    /// Integrates to `until` [s]; inputs change by their derivatives. On failure the state is that of the last good time.
    pub fn advance(&mut self, until: f64) -> Result<(), StepFailure> {
        self.advance_by(until, Way::default())
    }

    /// The last events.
    pub fn events(&self) -> &Events {
        &self.state.events
    }

    /// Applies the inputs at the present if they have changed, as the next step would at its start. Returns true if this is an
    /// event. The next step then continues from here, with the same bits as if the step had applied the inputs.
    pub fn begin(&mut self) -> bool {
        let Self { model, state, watched, inputs, .. } = self;
        let act_already = match &state.pending_step {
            Some(pending_step) => pending_step.inputs == *inputs && state.input_derivatives.is_none(),
            None => state.pause.as_ref().is_some_and(|pause| pause.inputs == *inputs),
        };
        if act_already {
            return false;
        }
        let count = state.events.count();
        begin_anew(model, inputs, (state, watched));
        state.pause = Some(Pause { now: 0.0, time: state.time(), inputs: *inputs });
        self.forces = None;
        state.events.count() != count
    }

    /// Integrates to `until` [s], or to the first event if the way `pauses`, or a part of the way to a communication point. The
    /// motion continues from there with the same bits as without a stop. An event at the start, see [`Self::begin`], does not
    /// pause the motion.
    pub fn advance_by(&mut self, until: f64, way: Way) -> Result<(), StepFailure> {
        self.forces = None;
        self.begin();
        let Self { model, state, watched, inputs, .. } = self;
        let model = &**model;
        if state.pending_step.is_some() && timeline::move_within(model, state, (until, way)) {
            progress::keep_together(model, state);
            return Ok(());
        }
        if let Gears::Ideal(ideal) = &model.gears
            && !ideal.body_effects.act_in(state)
        {
            let h = until - state.time();
            let (q, v, work) = (state.q, state.v, state.work);
            model.ideal.advance(state, inputs, h);
            if !state.is_motion_finite() {
                (state.q, state.v, state.work) = (q, v, work);
                return Err(StepFailure::not_finite(state.time()));
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
        let mut outcome = progress::integrate(model, (inputs, state, watched), (until, way));
        if outcome.as_ref().is_err_and(|failure| failure.time < before.1.time()) {
            // a step that was to lead beyond what has been shown cannot be completed: from here another may
            go_back((inputs, state, watched), &before, &saved);
            begin_anew(model, inputs, (state, watched));
            outcome = progress::integrate(model, (inputs, state, watched), (until, way));
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
        let is_closed = matches!(&self.model.gears, Gears::Ideal(ideal) if !ideal.body_effects.act_in(&self.state));
        if is_closed || self.model.parameters.solver.method == Method::FixedStep {
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

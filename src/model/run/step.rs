//! A step of a simulation, from the inputs of the host to the requested time. In the order of its parts:
//!
//! 1. Changed inputs are applied. Torques that change within a pending step let the integration continue; after any
//!    other change, it restarts.
//! 2. If the pending step already contains the requested time, its dense output gives the motion there
//!    (`without_solver`).
//! 3. Otherwise, the simulation moves from stop to stop. Stops are the requested time, a change of the equations, and a
//!    reset of the integrator's clock (`dynamics::timeline`).
//! 4. The solver evaluates and linearises the equations and tries a step. If its error is small and no switch is inside,
//!    the step is *pending*; otherwise, the next attempt is shorter, or ends at the switch (`integrate::driver`).
//! 5. Before a time beyond it is reached, the pending step is judged by its energy ledger, and replaced by shorter steps
//!    if the ledger does not close. Outputs that the host has read from it are not revised.
//! 6. The completed step adds to the ledger and to the memories of effects, such as fatigue damage.
//! 7. Friction and dog clutches switch, effects use new temperatures, and the loop continues.
//!
//! While inputs are constant, the solver's steps do not depend on the times that the host requests, because the pending
//! step ends beyond the present. Times on the integrator's clock, which is zero at the simulation time `begin`:
//!
//! ```text
//!   clock.time            clock.now                 clock.time + h           clock.end
//!       |------ pending step ------------------------------|                     |
//!   last completed    the present, or the target                        the equations end
//! ```
//!
//! Inputs exist twice: `Simulation::inputs` are those that the host has set, `State::inputs` those that act. The *anchor*
//! of dry friction is the position at which its spring is relaxed; it is fixed while a body sticks, and dragged while it
//! slides. A *shape* is a type of the equations with its number of degrees of freedom.

use super::budget::{self, budget};
use super::by_shape::{InShape, in_shape, in_shape_of};
use super::change::{begin_interval, torque_change_within};
use super::events::{apply_changes, break_tooth, follow_lock, next_change, switch};
use super::failure::{Cause, ExcessiveDeflection};
use super::interval::{Interval, LONGEST, RESOLUTION, arrive, clock, resumed, store, wrap_and_constrain};
use super::moving_inputs::{advance_inputs, inputs_move};
use super::{LedgerEquations, Simulation, StepFailure, imposed};
use crate::integrate::{self, FixedSteps, Point, Radau, Rodas5P, Solver, SolverContext, Step, Trajectory};
use crate::model::assembly::{Gears, Model};
use crate::model::dynamics::dogs::DogEquations;
use crate::model::dynamics::event::AdvanceOptions;
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::dynamics::rattle::Rattle;
use crate::model::dynamics::shape::Shape;
use crate::model::dynamics::timeline::LONGEST_INTERVAL;
use crate::model::dynamics::{Clock, CommunicationPoint, State, Stop, Sums};
use crate::model::effects::Memories;
use crate::model::scene::{Inputs, Method, PAIRS};

/// Effect of changed inputs on the integration.
#[derive(Clone, Copy, PartialEq)]
enum Beginning {
    /// The inputs have not changed.
    None,
    /// Only torques have changed, within the pending step, and accelerations by this value [rad/s²]; this is no event.
    Torques(f64),
    /// The integration restarts. The value is true if this is an event.
    Restart(bool),
}

impl Simulation {
    /// Integrates to `until` [s], as [`Self::advance_by`] does. Inputs follow their derivatives.
    pub fn advance(&mut self, until: f64) -> Result<(), StepFailure> {
        self.advance_by(until, AdvanceOptions::default())
    }

    /// Integrates to `until` [s], or to the first event if `options.pauses`. Inputs with derivatives and steps of fixed
    /// size only pause at stops. If `options.is_part`, `until` precedes the next communication point, and the next call
    /// continues with the same bits as without this call. An event at the start (see [`Self::begin`]) does not pause the
    /// motion. Fails if a step cannot be completed; the simulation is then at the last good time.
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
        // 1. take the inputs
        let acceleration_change = if let Beginning::Torques(by) = self.begin_step() { Some(by) } else { None };
        // 2. the pending step may contain the requested time
        if acceleration_change.is_none() && self.move_within_pending(until, options.is_part) {
            return Ok(());
        }
        // ideal gears without effects need no solver
        if matches!(&self.model.gears, Gears::Ideal(ideal) if !ideal.body_effects.act_in(&self.state)) {
            return self.advance_in_closed_form(until);
        }
        // 3. move from stop to stop
        let before = (self.inputs, self.state);
        let checkpoint = self.memories.checkpoint();
        let mut outcome = self.move_to(until, options, acceleration_change);
        if outcome.as_ref().is_err_and(|failure| failure.time < before.1.time()) {
            // only a pending step starts before the present, and it cannot be completed: restart at the present, from
            // where another step may succeed
            (self.inputs, self.state) = before;
            self.memories.roll_back(checkpoint);
            self.restart();
            outcome = self.move_to(until, options, None);
        }
        if outcome.is_ok() && !self.state.is_valid_without_pending_step() {
            outcome = Err(StepFailure::not_finite(self.state.time()));
            (self.inputs, self.state) = before;
            self.memories.roll_back(checkpoint);
        }
        outcome
    }

    // ---- 1. take the inputs

    /// Applies changed inputs at the present time, as [`Self::advance_by`] does at its start, unless only torques change.
    /// Returns true if this causes an event. The next call continues with the same bits as without this call.
    pub fn begin(&mut self) -> bool {
        self.begin_step() == Beginning::Restart(true)
    }

    #[inline(always)]
    fn begin_step(&mut self) -> Beginning {
        if self.inputs_act() { Beginning::None } else { self.begin_under_inputs() }
    }

    /// True if the inputs already act: a pending step was computed with them, or a restart has applied them.
    fn inputs_act(&self) -> bool {
        let State { inputs, timeline, pending_step, .. } = &self.state;
        let has_begun = if pending_step.is_some() { inputs.derivatives.is_none() } else { timeline.pause.is_some() };
        has_begun && inputs.values == self.inputs
    }

    fn begin_under_inputs(&mut self) -> Beginning {
        if let Some(acceleration_change) = torque_change_within(&self.model, &self.inputs, &self.state) {
            return Beginning::Torques(acceleration_change);
        }
        let count = self.state.events.count();
        self.restart();
        self.state.timeline.pause = Some(CommunicationPoint { clock: 0.0, time: self.state.time() });
        self.forces = None;
        Beginning::Restart(self.state.events.count() != count)
    }

    /// Restarts the integration at the present, because inputs or something else have changed.
    fn restart(&mut self) {
        let interrupts_step = self.state.pending_step.is_some();
        self.complete_pending();
        let Self { model, inputs, state, .. } = self;
        if interrupts_step {
            // the next steps are as long as those after the last discontinuity
            state.control.discontinuity(None);
        }
        imposed::follow_commands(model, inputs, state);
        apply_changes(model, inputs, state);
        state.timeline.begin_constant_inputs();
        state.inputs.values = *inputs;
    }

    // ---- 3. from stop to stop

    /// Integrates to `until` [s], or to the first event if `options.pauses`; the state then contains a pause.
    /// `acceleration_change` is the change of the accelerations at the present [rad/s²] if only torques have changed
    /// within the pending step. Fails if a step fails; the time is then the last one that was reached.
    fn move_to(
        &mut self,
        until: f64,
        options: AdvanceOptions,
        mut acceleration_change: Option<f64>,
    ) -> Result<(), StepFailure> {
        let mut budget = budget(&self.model);
        while self.state.time() < until {
            // find the next stop
            let Self { model, state, .. } = &*self;
            let (begin, events) = (state.time(), state.events.count());
            let stop = state.timeline.next_stop(next_change(model, state), until);
            // integrate to it
            let outcome = if inputs_move(model, state) || model.parameters.solver.method == Method::FixedStep {
                self.step_to_stop(stop, &mut budget)
            } else {
                self.step_past_stop(stop, options, acceleration_change.take(), &mut budget)
            };
            // inputs move to the time that was reached, also if a step has failed
            let Self { model, inputs, state, .. } = self;
            advance_inputs(model, inputs, state, state.time() - begin);
            outcome?;
            // an event has paused the motion, and `step_past_stop` has stored the pause
            if state.time() < stop.time {
                return Ok(());
            }
            // change the equations at the stop
            break_tooth(model, inputs, state);
            follow_lock(model, inputs, state);
            let pauses = if state.time() < until {
                options.pauses && state.events.count() != events
            } else {
                // without a pending step, the next part starts a new clock, on which the pause is at time 0
                options.is_part && state.pending_step.is_none()
            };
            if pauses {
                let clock = state.pending_step.as_ref().map_or(0.0, |step| step.clock.now);
                state.timeline.pause = Some(CommunicationPoint { clock, time: state.time() });
                return Ok(());
            }
        }
        Ok(())
    }

    /// Integrates in steps, the last of which ends at the stop. Inputs with derivatives and steps of fixed size need
    /// this.
    fn step_to_stop(&mut self, stop: Stop, budget: &mut u64) -> Result<(), StepFailure> {
        let begin = self.state.time();
        let length = stop.time - begin;
        let mut clock = Clock { now: length, ..Clock::new(length, f64::INFINITY) };
        let (mut outcome, mut extended) = (Ok(()), 0.0);
        while clock.time < clock.now && outcome.is_ok() {
            outcome = self.integrate_interval((&mut clock, begin, false, None), budget);
            if clock.time - extended >= LONGEST_INTERVAL {
                budget::extend(budget, &self.model, clock.time, length - clock.time);
                extended = clock.time;
            }
        }
        wrap_and_constrain(&self.model, &mut self.state);
        arrive(&mut self.state, stop, begin + clock.time, outcome)
    }

    /// Integrates in steps that do not depend on the stop. Ends if the pending step contains the stop, if the equations
    /// change at the stop, or if an event pauses the motion before the stop.
    fn step_past_stop(
        &mut self,
        stop: Stop,
        options: AdvanceOptions,
        acceleration_change: Option<f64>,
        budget: &mut u64,
    ) -> Result<(), StepFailure> {
        let mut clock = clock(&self.model, &self.state);
        let mut change = acceleration_change.map(|by| (begin_interval(&mut self.state, &mut clock), by));
        let mut last = self.state.timeline.last_communication_point(&clock);
        let mut begin = last.time - last.clock;
        let mut target = if stop.is_change { clock.end } else { last.clock + (stop.time - last.time) };
        clock.now = target;
        let mut advanced = 0.0;
        // one iteration per interval of the clock
        loop {
            let outcome = self.integrate_interval((&mut clock, begin, options.pauses, change.take()), budget);
            let Self { model, state, .. } = self;
            let mut reached = clock.time;
            if let Some(pending_step) = &state.pending_step {
                pending_step.write_motion(model.layout.count(), [&mut state.q, &mut state.v]);
                reached = clock.now.min(pending_step.end());
            }
            wrap_and_constrain(model, state);
            // an event has paused the motion before the stop
            if outcome.is_ok() && state.pending_step.is_some() && clock.now < target {
                (state.timeline.pause, state.timeline.now) = (Some(last), begin + clock.now);
                return Ok(());
            }
            // a step has failed, the pending step contains the stop, or the equations change there
            if outcome.is_err() || state.pending_step.is_some() || clock.time >= clock.end {
                let arrived = arrive(state, stop, begin + reached, outcome);
                if options.is_part && state.pending_step.is_some() {
                    state.timeline.pause = Some(last);
                }
                return arrived;
            }
            // the interval has ended before the stop: continue with a reset clock
            let by = clock.set_back();
            (begin, last.clock, target) = (begin + by, last.clock - by, target - by);
            advanced += by;
            budget::extend(budget, model, advanced, stop.time - (begin + clock.time));
        }
    }

    /// Integrates up to the target on the `clock`, an event that pauses, or the next reset of the clock. Planets that move
    /// identically are integrated as one group.
    fn integrate_interval(
        &mut self,
        (clock, begin, pauses, change): (&mut Clock, f64, bool, Option<(f64, f64)>),
        budget: &mut u64,
    ) -> Result<(), StepFailure> {
        let Self { model, state, inputs, memories, .. } = self;
        let grouped = model.merged.as_deref().filter(|teeth| state.planets_move_alike(teeth, &model.layout));
        let work = Interval {
            model,
            state: &mut *state,
            inputs,
            memories,
            clock,
            budget,
            begin,
            was_read: false,
            pauses,
            change,
        };
        let Some(teeth) = grouped else { return in_shape(model, work) };
        let outcome = in_shape_of(teeth, model, work);
        state.let_others_follow(&model.layout);
        outcome
    }
}

impl InShape for Interval<'_> {
    type Output = Result<(), StepFailure>;

    fn inputs_and_state(&self) -> (&Inputs, &State) {
        (self.inputs, self.state)
    }

    /// Steps until the pending step contains the clock's `now`, the equations end, or the clock must be reset. Fails if
    /// a step cannot be completed within the budget of attempts, or if a tooth bends too far.
    fn run<const N: usize, S: Shape<N>, E: LedgerEquations<N> + ?Sized>(
        self,
        equations: &mut E,
    ) -> Result<(), StepFailure> {
        let Self { model, state, inputs, memories, clock, budget, begin, was_read, pauses, change } = self;
        let before = state.statistics;
        let mut trajectory = resumed(state, clock);
        if let Some((time, acceleration_change)) = change {
            // the equations contain the new torques; `change` takes them back for the part of the step before the change
            equations.applied_mut().change = inputs.torques_since(&state.inputs.values);
            if !trajectory.change_at(time, acceleration_change) {
                // no part of the pending step precedes the change
                state.control.discontinuity(Some(acceleration_change));
            }
        }
        // no reset if the target is the end of the equations, which is at most one and a half intervals away
        let reset_at = if clock.now < clock.end { LONGEST_INTERVAL } else { f64::INFINITY };
        let depends_on_temperature = model.thermal.is_some() && model.body_effects().depends_on_temperature();
        if depends_on_temperature {
            trajectory.longest = LONGEST.min(state.sums.thermal.longest);
        }
        let (mut outcome, mut continues) = (Ok(()), true);
        while continues && outcome.is_ok() {
            let mut anchors = equations.applied().anchors();
            let State { control, statistics, rattle, sums, .. } = &mut *state;
            let mut recorder = Recorder {
                model,
                begin,
                sums,
                memories,
                rattle: (!was_read).then_some(rattle),
                anchors: &mut anchors,
                depends_on_temperature,
                reset_at,
                switches: false,
            };
            // 4. to 6. try, judge and complete steps until one passes `now` or changes the equations
            let tolerance = model.parameters.solver.relative_tolerance;
            let context = SolverContext { tolerance, control, statistics, budget };
            outcome = recorder.follow::<N, S, E>(equations, &mut trajectory, clock.now, context);
            let switches = recorder.switches;
            // 7. change the equations: effects use new temperatures, friction and dog clutches switch
            equations.applied_mut().set_anchors(&anchors);
            let temperatures_change = depends_on_temperature && state.sums.thermal.is_update_due();
            if temperatures_change {
                state.sums.thermal.use_temperatures();
                equations.applied_mut().update_temperatures(model.body_effects(), state.lock, &state.sums.thermal.used);
                trajectory.longest = LONGEST.min(state.sums.thermal.longest);
            }
            if switches {
                let is_event = switch(equations, state, &trajectory.point, (begin, trajectory.time));
                if is_event && pauses && trajectory.time < clock.now {
                    // the next pending step starts at the event; an event before the present, which shorter steps in
                    // place of a pending one may find, pauses at the present
                    clock.now = trajectory.time.max(state.time() - begin);
                }
            }
            let is_over = trajectory.time >= reset_at || trajectory.end - trajectory.time <= RESOLUTION;
            continues = (switches || temperatures_change) && !is_over;
        }
        state.inputs.values = *inputs;
        state.friction = equations.applied().friction_state;
        store(state, clock, &trajectory, outcome.is_ok());
        outcome.map_err(|cause| cause.explain(begin + clock.time, (model, inputs, state), &before))
    }
}

/// Recorder of completed steps.
struct Recorder<'a> {
    model: &'a Model,
    begin: f64,
    sums: &'a mut Sums,
    memories: &'a mut Memories,
    /// Counts of impacts between flanks; `None` if the host has already read outputs at the end.
    rattle: Option<&'a mut Rattle>,
    /// Anchors of the springs of dry friction.
    anchors: &'a mut [f64; PAIRS],
    depends_on_temperature: bool,
    /// Time at which the clock is reset [s].
    reset_at: f64,
    /// True if friction or a dog clutch is due to switch.
    switches: bool,
}

impl Recorder<'_> {
    /// Follows the `trajectory` with the method of the scene until its pending step contains `until` [s], its equations
    /// end, or they change.
    #[inline(always)]
    fn follow<const N: usize, S: Shape<N>, E: LedgerEquations<N> + ?Sized>(
        &mut self,
        equations: &E,
        trajectory: &mut Trajectory<N, LedgerRates>,
        until: f64,
        context: SolverContext,
    ) -> Result<(), Cause> {
        match self.model.parameters.solver.method {
            Method::FixedStep if S::HAS_FIXED_STEPS => self.follow_in_fixed_steps(equations, trajectory, context),
            Method::Radau if S::HAS_RADAU => self.follow_by(&Radau, equations, trajectory, until, context),
            _ => self.follow_by(&Rodas5P, equations, trajectory, until, context),
        }
    }

    /// Follows the `trajectory` by a `method` with error control.
    #[inline]
    fn follow_by<const N: usize, E: LedgerEquations<N> + ?Sized>(
        &mut self,
        method: &impl integrate::Method,
        equations: &E,
        trajectory: &mut Trajectory<N, LedgerRates>,
        until: f64,
        context: SolverContext,
    ) -> Result<(), Cause> {
        let mut solver = Solver::new(method, equations, context, trajectory);
        loop {
            // 4. evaluate and linearise the equations, and try a step: it becomes pending if its error is small enough
            let Some(pending) = &trajectory.pending else {
                solver.attempt(trajectory)?;
                continue;
            };
            // it stays pending if it contains the requested time
            let part = trajectory.accepted_part(pending);
            if trajectory.stays_pending(&part, until) {
                return Ok(());
            }
            // 5. judge its energy: if the ledger does not close, try a shorter step
            let judged = solver.judge(trajectory, pending, &part);
            if !judged.is_balanced {
                solver.reject_ledger(trajectory, &part, &judged)?;
                continue;
            }
            // 6. complete it
            self.check_deflection(equations, &judged.end)?;
            let step = solver.complete(trajectory, &part, judged);
            if self.record(equations, &step) || part.is_last {
                return Ok(());
            }
        }
    }

    /// Follows the `trajectory` to its end in steps of fixed size, which have no error control.
    fn follow_in_fixed_steps<const N: usize, E: LedgerEquations<N> + ?Sized>(
        &mut self,
        equations: &E,
        Trajectory { point, time, end, .. }: &mut Trajectory<N, LedgerRates>,
        SolverContext { statistics, budget, .. }: SolverContext,
    ) -> Result<(), Cause> {
        let size = self.model.parameters.solver.fixed_step;
        let mut steps = FixedSteps::new(equations, point, [*time, *end], size, statistics);
        loop {
            let before = (*point, *time);
            let Some(step) = steps.next(point, time, (statistics, budget))? else { return Ok(()) };
            if let Err(tooth) = self.check_deflection(equations, step.end) {
                (*point, *time) = before;
                return Err(tooth.into());
            }
            if self.record(equations, &step) {
                return Ok(());
            }
        }
    }

    /// Counts impacts at the `end` of a step. Fails if a tooth bends too far there.
    #[inline(always)]
    fn check_deflection<const N: usize, E: LedgerEquations<N> + ?Sized>(
        &mut self,
        equations: &E,
        end: &Point<N>,
    ) -> Result<(), ExcessiveDeflection> {
        if let Some(rattle) = &mut self.rattle {
            rattle.add_step(equations.check_deflection(end)?);
        }
        Ok(())
    }

    /// Adds a completed step to the ledger and to the memories of effects, and lets sliding friction drag its anchors.
    /// Returns true if the equations change at its end, or if the clock must be reset.
    #[inline(always)]
    fn record<const N: usize, E: LedgerEquations<N> + ?Sized>(
        &mut self,
        equations: &E,
        step: &Step<N, LedgerRates>,
    ) -> bool {
        let [.., at_end] = &step.ledger_rates;
        equations.record(self.model, step, (self.begin, self.sums, Some(self.memories)));
        equations.drag_anchors(step.end, at_end, self.anchors);
        self.switches = equations.is_switch_due(step.end, step.time);
        let temperatures_change = self.depends_on_temperature && self.sums.thermal.is_update_due();
        self.switches || temperatures_change || step.time >= self.reset_at
    }
}

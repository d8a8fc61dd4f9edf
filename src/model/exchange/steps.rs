//! Steps and events of model exchange, in which the host's solver integrates the states.
//!
//! Imposed motions follow their commands immediately; their states have no effect. Trial steps of the host's solver
//! leave no trace: only completed steps are recorded, and friction and teeth switch only at events.

use super::states::STATES;
use crate::integrate::{Point, SecondOrder, Step};
use crate::model::dynamics::dogs::DogEquations;
use crate::model::dynamics::with_equations;
use crate::model::dynamics::{Actuated, FrictionEquations, State};
use crate::model::run::events::{
    apply_changes, break_tooth, breaks_tooth, energy, has_commanded_changed, has_dog_command_changed, has_lock_moved,
    next_change, record_holds,
};
use crate::model::run::moving_inputs::acting_inputs;
use crate::model::run::{Accepted, LedgerEquations, Simulation, StepFailure, imposed};
use crate::model::scene::{InputDerivatives, Inputs, MAX_DOF};

/// Result of an event in model exchange.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Update {
    /// True if states have changed.
    pub states_changed: bool,
    /// Time of the next event, if it is already known [s].
    pub next: Option<f64>,
}

impl Simulation {
    /// Starts model exchange: from now on, the host's solver integrates the states.
    pub fn start_model_exchange(&mut self) {
        self.accept(self.inputs);
    }

    /// Records the present state as the end of a completed step. `followed_commands` are the latest commands to whose
    /// jumps of imposed speeds the free speeds have responded.
    fn accept(&mut self, followed_commands: Inputs) {
        let (State { q, v, inputs, .. }, time) = (self.state, self.state.time());
        if let Some(actuated) = &mut self.state.inputs.actuated {
            let present = actuated.at(&self.model.body_effects().actuators, [&inputs.values, &self.inputs], time);
            *actuated = Actuated { since: Some(time), ..present };
        }
        self.state.inputs.values = self.inputs;
        self.accepted = Some(Accepted { time, q, v, followed_commands });
        self.forces = None;
    }

    /// Sets the time [s].
    pub fn set_time(&mut self, time: f64) {
        self.state.timeline.now = time;
    }

    /// Moves to `states`, except imposed motions, which follow their commands. If a step is pending, it is first
    /// completed up to the present time.
    pub fn set_states(&mut self, states: &[f64; STATES]) {
        self.complete_pending();
        let (mut q, mut v) = (self.state.q, self.state.v);
        self.set_from_states(states, &mut q, &mut v);
        for i in 0..MAX_DOF {
            // a position that is not wrapped has an infinite period and the count 0
            let count = self.state.whole_periods[i];
            self.state.q[i] = if count == 0 { q[i] } else { q[i] - count as f64 * self.model.periods[i] };
        }
        self.state.v = v;
        self.follow_commands();
    }

    /// Moves to `states` at an event. They must differ from the present states only in positions. The energy of this
    /// jump is work of the host. Fails if the step up to the event fails.
    pub fn displace_to_states(&mut self, states: &[f64; STATES]) -> Result<(), StepFailure> {
        self.complete_step_to_event()?;
        let stored = |simulation: &Self, from: &Accepted| {
            energy(&simulation.model, &simulation.inputs, &from.applied_to(&simulation.state))
        };
        let before = self.accepted.map(|from| stored(self, &from));
        self.set_states(states);
        if let (Some(before), Some(mut from)) = (before, self.accepted) {
            from.q = self.state.q;
            self.state.sums.work += stored(self, &from) - before;
            self.accepted = Some(from);
        }
        Ok(())
    }

    /// Sets imposed motions to their commands.
    pub fn follow_commands(&mut self) {
        imposed::set(&self.model, &self.inputs, &mut self.state);
        self.forces = None;
    }

    /// Records the step from the last completed step to the present. Returns true if an event is due. Fails if a tooth
    /// bends too far at its end.
    pub fn complete_step(&mut self) -> Result<bool, StepFailure> {
        let Some(from) = self.accepted else { return Ok(false) };
        let model = &*self.model;
        let (inputs, state, memories) = (&self.inputs, &mut self.state, &mut self.memories);
        let mut is_due = false;
        let h = state.time() - from.time;
        if h > 0.0 {
            let mut begin = from.applied_to(state);
            let before = energy(model, inputs, &begin);
            imposed::set(model, inputs, &mut begin);
            // the energy of a jump of imposed speeds is impulsive work of the input
            state.sums.work += energy(model, inputs, &begin) - before;
            let outcome = with_equations!(model, state, inputs, |equations| {
                let (start, end): (Point<N>, Point<N>) = (begin.point(), state.point());
                let before = acting_inputs(model, &state.inputs.values, &begin);
                let (_, first) = equations.under(&before, &InputDerivatives::ZERO).evaluate(&start);
                let (_, last) = equations.evaluate(&end);
                // the motion in between is unknown: for stiff teeth, no curve through both ends describes it
                let ledger_rates = [first, first.mean(&last), last];
                let step = Step { h, time: h, start: &start, end: &end, ledger_rates, dense_output: None };
                let outcome = equations.check_deflection(&end).map(drop);
                if outcome.is_ok() {
                    equations.record(model, &step, (from.time, &mut state.sums, Some(memories)));
                    if state.sums.thermal.is_update_due() {
                        state.sums.thermal.use_temperatures();
                    }
                }
                let mut anchors = equations.applied().anchors();
                equations.drag_anchors(&end, &last, &mut anchors);
                equations.applied_mut().set_anchors(&anchors);
                is_due = equations.is_switch_due(&end, 0.0);
                state.friction = equations.applied().friction_state;
                outcome
            });
            outcome.map_err(|tooth| StepFailure { time: state.time(), message: tooth.message(model) })?;
            state.statistics.accepted += 1;
            state.statistics.evaluations += 2;
            state.control.last = h;
            state.wrap(&model.periods, &model.body_effects().pairs);
        }
        let jumps = imposed::is_impulse(model, &from.followed_commands, inputs);
        let commanded = has_lock_moved(model, inputs, state)
            || has_commanded_changed(model, inputs, state)
            || has_dog_command_changed(model, inputs, state);
        let due = is_due || jumps || commanded || breaks_tooth(model, inputs, state);
        self.accept(from.followed_commands);
        Ok(due)
    }

    /// True if time and inputs have not changed since the last completed step or event.
    pub fn is_accepted(&self) -> bool {
        self.accepted.is_some_and(|from| from.time == self.state.time() && self.state.inputs.values == self.inputs)
    }

    /// Time of the next event, if it is already known [s].
    pub fn next_event(&self) -> Option<f64> {
        next_change(&self.model, &self.state)
    }

    /// Completes the step up to an event, because the host does not complete the step before an event whose time is
    /// known. Fails as [`Self::complete_step`] does.
    fn complete_step_to_event(&mut self) -> Result<(), StepFailure> {
        if self.accepted.is_some_and(|from| from.time < self.state.time()) {
            self.complete_step()?;
        }
        Ok(())
    }

    /// Handles an event: applies the changes of commands, friction and teeth that are due. Fails as
    /// [`Self::complete_step`] does.
    pub fn update(&mut self) -> Result<Update, StepFailure> {
        self.complete_step_to_event()?;
        let (model, inputs, state) = (&*self.model, &self.inputs, &mut self.state);
        let (before, followed) = match &self.accepted {
            Some(from) => (from.applied_to(state), from.followed_commands),
            None => (*state, *inputs),
        };
        imposed::follow_impulse(model, &followed, inputs, state);
        imposed::set(model, inputs, state);
        // the energy of a jump of imposed speeds is impulsive work of the input
        state.sums.work += energy(model, inputs, state) - energy(model, inputs, &before);
        apply_changes(model, inputs, state);
        let friction = state.friction;
        with_equations!(model, state, inputs, |equations| {
            if equations.is_friction_due(&state.point(), 0.0) {
                equations.settle_friction(&state.point(), 0.0, false, &mut state.sums.heat);
                state.friction = equations.applied().friction_state;
            }
        });
        record_holds(&friction, state);
        break_tooth(model, inputs, state);
        let states_changed = before.q != state.q || before.v != state.v;
        self.accept(self.inputs);
        Ok(Update { states_changed, next: self.next_event() })
    }
}

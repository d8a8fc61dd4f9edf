//! Co-simulation with events: steps that end at an event or at the end of a solver's step, and values that change only at events.

use serde::{Deserialize, Serialize};

use super::instance::check_step;
use super::{CallError, CallResult, Instance, Kind, Phase};
use crate::model::{Event, StepFailure, Update, Way, six_digits};

/// What the host of a co-simulation allows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Allowed {
    /// It handles events in event mode.
    pub events: bool,
    /// A step may end at an event.
    pub early_return: bool,
    /// Addresses of the host's function to call at the solver's steps, and of that function's argument; 0 = none.
    pub update: [usize; 2],
}

/// Outputs that change only at events, where the host handles events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Discrete {
    /// The last event.
    pub event: Event,
    /// Bit masks of the bodies that dry friction holds: side gears, planets, wheels.
    pub held: [f64; 3],
}

/// How a step, or a part of it, ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ended {
    /// The time that was reached [s].
    pub time: f64,
    /// Whether the host is to handle an event.
    pub event: bool,
    /// Whether an event has ended the step before its end.
    pub early: bool,
    /// Whether the step is over, at its end or early; otherwise only a part of it is done.
    pub is_done: bool,
}

impl Instance {
    /// Refuses calls of co-simulation on an instance for model exchange.
    pub fn check_co_simulation(&self) -> CallResult {
        if self.now.kind == Kind::CoSimulation {
            return Ok(());
        }
        Err(CallError::error("this call is for co-simulation, but the instance is for model exchange"))
    }

    /// A step from `point` over `h` to `until` [s], or to the first event if the host allows early return; `in_parts`: only up to
    /// the end of the solver's next step.
    pub fn step_to_event(&mut self, [point, h, until]: [f64; 3], in_parts: bool) -> CallResult<Ended> {
        self.check_co_simulation()?;
        let stop = self.now.stop_time;
        let simulation = self.simulation()?;
        check_step(simulation.time(), stop, point, h)?;
        let next = if in_parts { simulation.next_solver_time() } else { Ok(None) };
        match next.map_err(|failure| self.step_failed(&failure))? {
            Some(next) if next < until => self.move_on(next, true),
            _ => self.move_on(until, false),
        }
    }

    fn move_on(&mut self, until: f64, is_part: bool) -> CallResult<Ended> {
        let allowed = self.allowed;
        let simulation = self.simulation()?;
        if until > simulation.time() {
            let outcome = simulation.advance_by(until, Way { pauses: allowed.early_return, is_part });
            if let Err(failure) = outcome {
                return Err(self.step_failed(&failure));
            }
        }
        let simulation = self.simulation()?;
        let (time, count) = (simulation.time(), simulation.last_event().count);
        self.warn_while_running();
        if self.now.stop_time.is_some_and(|stop| time >= stop) {
            self.warn_at_end();
        }
        let (early, event) = (time < until, allowed.events && count != self.now.discrete.event.count);
        let is_done = early || !is_part;
        Ok(Ended { time, event: event && is_done, early, is_done })
    }

    /// The error of a step that failed.
    #[cold]
    pub fn step_failed(&mut self, failure: &StepFailure) -> CallError {
        self.now.phase = Phase::StepFailed;
        let last = self.now.simulation.as_ref().map_or(f64::NAN, crate::model::Simulation::time);
        CallError::discard(format!(
            "{failure}; values are those of the last successful time {:?} s; continue with {} or {}",
            six_digits(last),
            self.interface.set_state,
            self.interface.reset
        ))
    }

    /// Gives outputs that change only at events their present values.
    pub fn publish(&mut self) -> CallResult {
        let simulation = self.simulation()?;
        self.now.discrete = Discrete { event: *simulation.last_event(), held: simulation.ledger().held };
        Ok(())
    }

    /// Outputs that change only at events: as published where the host handles events, else their present values.
    pub fn discrete(&mut self) -> CallResult<Discrete> {
        if !self.allowed.events {
            self.publish()?;
        }
        Ok(self.now.discrete)
    }

    /// Enters event mode: in model exchange, or between steps of co-simulation.
    pub fn enter_event_mode_of_any(&mut self) -> CallResult {
        if self.now.kind == Kind::CoSimulation && !self.allowed.events {
            return Err(CallError::error("the host has said that it does not use event mode"));
        }
        self.enter_event_mode()
    }

    /// Leaves event mode for the next step.
    pub fn enter_step_mode(&mut self) -> CallResult {
        self.check_co_simulation()?;
        self.now.phase = Phase::StepComplete;
        Ok(())
    }

    /// Leaves event mode: the host's solver continues.
    pub fn enter_continuous_time_mode_of_exchange(&mut self) -> CallResult {
        self.check_model_exchange()?;
        self.enter_continuous_time_mode()
    }

    /// Discrete values follow from the states and inputs; there is nothing to iterate.
    pub fn evaluate_discrete_states(&mut self) -> CallResult {
        Ok(())
    }

    /// Event iteration, of either kind of instance: one iteration is always enough.
    pub fn update_discrete_states(&mut self) -> CallResult<Update> {
        if self.now.kind == Kind::ModelExchange {
            return self.new_discrete_states();
        }
        self.publish()?;
        Ok(Update { states_changed: false, next: None })
    }

    /// Structural parameters may be set from here on.
    pub fn enter_configuration(&mut self) -> CallResult {
        self.now.phase = Phase::Configuration;
        Ok(())
    }

    /// Structural parameters stay as they are from here on.
    pub fn exit_configuration(&mut self) -> CallResult {
        self.now.phase = Phase::Instantiated;
        Ok(())
    }
}

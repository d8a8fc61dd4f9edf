//! Co-simulation with events: steps that end at an event or at the end of a solver step, and values that change only at
//! events.

use serde::{Deserialize, Serialize};

use super::{CallError, CallResult, Instance, Kind, Phase};
use crate::model::{AdvanceOptions, Event, HELD, StepFailure, Update, six_digits};
use crate::numeric::finite;

/// Features that the host of a co-simulation allows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Allowed {
    /// True if the host handles events in event mode. Hosts of model exchange always do.
    pub events: bool,
    /// True if a step may end early, at an event.
    pub early_return: bool,
    /// Address of the host's callback after solver steps, and address of its argument; 0 = none.
    pub update: [usize; 2],
}

/// Outputs that change only at events if the host handles events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Discrete {
    /// The last event that was reported to the host.
    pub event: Event,
    /// Numbers of bodies that dry friction holds: side gears, groups of planets, wheels, clutches.
    pub held: [f64; HELD],
}

finite!(Discrete { event, held });

/// Result of an event iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// Result of the event.
    pub update: Update,
    /// True if there are more events to report, so that the host iterates again.
    pub is_needed: bool,
}

/// End of a step, or of a part of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ended {
    /// Time that was reached [s].
    pub time: f64,
    /// True if the host must handle an event.
    pub event: bool,
    /// True if an event has ended the step early.
    pub early: bool,
    /// True if the step is finished, on time or early. False if only a part of it is done.
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

    /// Advances from `point` by `h` to `until` [s], or to the first event if the host allows early return. Inputs that
    /// were set may cause an event at `point`. With `in_parts`, advances only to the end of the next solver step.
    pub fn step_to_event(&mut self, [point, h, until]: [f64; 3], in_parts: bool) -> CallResult<Ended> {
        self.check_co_simulation()?;
        let time = self.simulation()?.time();
        self.check_step(time, point, h)?;
        let ramps = self.now.begin_ramp(until);
        let outcome = self.move_to_event(until, in_parts);
        if ramps {
            self.now.end_ramp(until);
        }
        outcome
    }

    fn move_to_event(&mut self, until: f64, in_parts: bool) -> CallResult<Ended> {
        let may_end_early = self.allowed.early_return;
        let simulation = self.simulation()?;
        // a command that starts or stops sticking is an event at the start of the step
        if may_end_early && simulation.begin() && simulation.time() < until {
            return self.ended(until, in_parts);
        }
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
            let outcome = simulation.advance_by(until, AdvanceOptions { pauses: allowed.early_return, is_part });
            if let Err(failure) = outcome {
                return Err(self.step_failed(&failure));
            }
        }
        self.ended(until, is_part)
    }

    /// Returns how a step to `until` [s], or a part of it, has ended at the present time.
    fn ended(&mut self, until: f64, is_part: bool) -> CallResult<Ended> {
        let simulation = self.simulation()?;
        let (time, count) = (simulation.time(), simulation.events().count());
        self.warn_while_running();
        if self.now.stop_time.is_some_and(|stop| time >= stop) {
            self.warn_at_end();
        }
        let event = self.allowed.events && self.now.discrete.is_none_or(|reported| reported.event.count != count);
        let early = time < until;
        let is_done = early || !is_part;
        Ok(Ended { time, event: event && is_done, early, is_done })
    }

    /// Returns the error of a step that failed.
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

    /// Returns the present values of the outputs that change only at events.
    fn present(&mut self) -> CallResult<Discrete> {
        let simulation = self.simulation()?;
        Ok(Discrete { event: *simulation.events().last(), held: simulation.ledger().held })
    }

    /// Publishes the present values of the outputs that change only at events, if the host handles events.
    pub fn publish(&mut self) -> CallResult {
        self.now.discrete = if self.allowed.events { Some(self.present()?) } else { None };
        Ok(())
    }

    /// Publishes the next unpublished event and the bodies that friction holds now. Returns true if more events remain.
    fn publish_next(&mut self) -> CallResult<bool> {
        let mut reported = self.present()?;
        let events = *self.simulation()?.events();
        if let Some(before) = self.now.discrete {
            reported.event = *events.after(before.event.count).unwrap_or(events.last());
        }
        self.now.discrete = Some(reported);
        Ok(reported.event.count != events.count())
    }

    /// Returns the outputs that change only at events: published values if the host handles events, otherwise present
    /// values. Before the end of initialisation, nothing is published.
    pub fn discrete(&mut self) -> CallResult<Discrete> {
        match self.now.discrete {
            Some(reported) if self.allowed.events => Ok(reported),
            _ => self.present(),
        }
    }

    /// Enters event mode, in model exchange or between steps of co-simulation. Changes nothing in event mode.
    pub fn enter_event_mode(&mut self) -> CallResult {
        if self.now.kind == Kind::CoSimulation && !self.allowed.events {
            return Err(CallError::error("the host has said that it does not use event mode"));
        }
        self.now.phase = Phase::Event;
        Ok(())
    }

    /// Leaves event mode for the next step.
    pub fn enter_step_mode(&mut self) -> CallResult {
        self.check_co_simulation()?;
        self.now.phase = Phase::StepComplete;
        Ok(())
    }

    /// Leaves event mode, after which the host's solver continues.
    pub fn enter_continuous_time_mode(&mut self) -> CallResult {
        self.check_model_exchange()?;
        self.now.phase = Phase::ContinuousTime;
        Ok(())
    }

    /// Performs an event iteration of either kind of instance. The first iteration makes all pending changes; each
    /// iteration reports one event.
    pub fn update_discrete_states(&mut self) -> CallResult<Iteration> {
        let update = if self.now.kind == Kind::CoSimulation {
            self.apply_commands()?;
            Update { states_changed: false, next: None }
        } else if self.only_reports()? {
            Update { states_changed: false, next: self.simulation()?.next_event() }
        } else {
            self.new_discrete_states()?
        };
        Ok(Iteration { update, is_needed: self.publish_next()? })
    }

    /// True if an iteration in model exchange only reports another event, because an earlier iteration at this time has
    /// already made all changes.
    fn only_reports(&mut self) -> CallResult<bool> {
        let published = self.now.discrete.map(|discrete| discrete.event.count);
        let simulation = self.simulation()?;
        Ok(simulation.is_accepted() && published.is_some_and(|count| count != simulation.events().count()))
    }

    /// Applies the inputs now if they cause an event. Otherwise, they apply from the next step on.
    fn apply_commands(&mut self) -> CallResult {
        let simulation = self.simulation()?;
        let mut begun = simulation.clone();
        if begun.begin() {
            *simulation = begun;
        }
        Ok(())
    }

    /// Enters configuration mode, in which structural parameters may be set.
    pub fn enter_configuration(&mut self) -> CallResult {
        self.now.phase = Phase::Configuration;
        Ok(())
    }

    /// Leaves configuration mode; structural parameters are then fixed.
    pub fn exit_configuration(&mut self) -> CallResult {
        self.now.phase = Phase::Instantiated;
        Ok(())
    }
}

//! Model exchange: the host's solver integrates the states, and the instance computes derivatives and events.

use crate::FULL;

use super::{CallError, CallResult, InputArray, Instance, Kind, OutputArray, Phase};
use crate::model::{INDICATORS, STATES, Simulation, StepFailure, Update};
use crate::variables::{Variable, table};

impl Instance {
    /// Refuses calls of model exchange on an instance for co-simulation.
    pub fn check_model_exchange(&self) -> CallResult {
        if FULL && self.now.kind == Kind::ModelExchange {
            return Ok(());
        }
        Err(CallError::error("this call is for model exchange, but the instance is for co-simulation"))
    }

    /// Returns the simulation of an instance for model exchange.
    fn exchange_simulation(&mut self) -> CallResult<&mut Simulation> {
        self.check_model_exchange()?;
        self.simulation()
    }

    /// Performs an event iteration. A single iteration is always enough.
    pub fn new_discrete_states(&mut self) -> CallResult<Update> {
        let update = self.exchange_simulation()?.update();
        self.valid_after(update)
    }

    /// Completes a step of the host's solver. Returns true if an event is due.
    pub fn completed_integrator_step(&mut self) -> CallResult<bool> {
        let outcome = self.exchange_simulation()?.complete_step();
        let due = self.valid_after(outcome)?;
        self.warn_while_running();
        Ok(due)
    }

    /// Returns the result of a completed step or event. After a failure, the simulation cannot continue.
    fn valid_after<T>(&mut self, outcome: Result<T, StepFailure>) -> CallResult<T> {
        let failure = match outcome {
            // wrapped positions and accumulated energies may overflow even if the states themselves do not
            Ok(result) if self.now.simulation.as_ref().is_some_and(|s| s.state().is_valid()) => return Ok(result),
            Ok(_) => "the simulation cannot continue from the states at the end of this step".to_owned(),
            Err(failure) => failure.to_string(),
        };
        self.now.phase = Phase::Error;
        let interface = self.interface;
        Err(CallError::error(format!("{failure}; continue with {} or {}", interface.set_state, interface.reset)))
    }

    /// Sets the time [s].
    pub fn set_time(&mut self, time: f64) -> CallResult {
        if !time.is_finite() {
            return Err(CallError::error(format!("time {time} s is not a finite number")));
        }
        self.exchange_simulation()?.set_time(time);
        Ok(())
    }

    /// Sets all states.
    pub fn set_continuous_states(&mut self, values: InputArray<f64>) -> CallResult {
        let states: [f64; STATES] = values.copied().ok_or_else(|| wrong_count("states", STATES, values.len()))?;
        for (index, state) in table().states.iter().zip(states) {
            check_state(&table().rows[*index], state)?;
        }
        self.move_to_states(&states)
    }

    /// True if the variable is a continuous state that the host of a model exchange may set now. Between events, the
    /// host may set all states. At events, it may set only positions, and only with FMI 3.0, because events set
    /// velocities themselves.
    pub(super) fn may_set_state(&self, reference: u32) -> bool {
        FULL && self.now.kind == Kind::ModelExchange
            && table().state(reference).is_some()
            && match self.now.phase {
                Phase::ContinuousTime => true,
                Phase::Event => self.interface.version > 2 && !table().is_velocity(reference),
                _ => false,
            }
    }

    /// Moves to valid `states`.
    pub(super) fn move_to_states(&mut self, states: &[f64; STATES]) -> CallResult {
        let is_event = self.now.phase == Phase::Event;
        let simulation = self.exchange_simulation()?;
        if is_event {
            let outcome = simulation.displace_to_states(states);
            return self.valid_after(outcome);
        }
        simulation.set_states(states);
        Ok(())
    }

    /// Returns all states.
    pub fn get_continuous_states(&mut self, values: OutputArray<f64>) -> CallResult {
        let states = self.exchange_simulation()?.states();
        fill("states", &states, values, |k| format!("{} is not a finite number", table().rows[table().states[k]].name))
    }

    /// Returns the derivatives of all states.
    pub fn get_derivatives(&mut self, values: OutputArray<f64>) -> CallResult {
        let rates = self.exchange_simulation()?.state_rates();
        fill("derivatives", &rates, values, |k| {
            let name = table().rows[table().derivatives[k]].name;
            format!("{name} is not a finite number at these states; take a shorter step or check the inputs")
        })
    }

    /// Returns all event indicators.
    pub fn get_event_indicators(&mut self, values: OutputArray<f64>) -> CallResult {
        let indicators = self.exchange_simulation()?.indicators();
        fill("event indicators", &indicators, values, |k| {
            format!(
                "event indicator {k} is not a finite number at these states; take a shorter step or check the inputs"
            )
        })
    }

    /// Returns the nominal values of the states.
    pub fn get_nominals(&mut self, values: OutputArray<f64>) -> CallResult {
        self.check_model_exchange()?;
        let nominals = table().states.map(|i| table().rows[i].nominal.unwrap_or(1.0));
        fill("nominals", &nominals, values, |_| String::new())
    }
}

/// Refuses a value of a state that is not finite.
pub(super) fn check_state(row: &Variable, value: f64) -> CallResult {
    if value.is_finite() {
        return Ok(());
    }
    Err(CallError::discard(format!("{} = {value} is not a finite number", row.name)))
}

/// Writes `numbers` into `values`. Fails if the host expects a different count of `what`, or if a number is not finite,
/// with the message that `reason` returns for its index.
fn fill(what: &str, numbers: &[f64], values: OutputArray<f64>, reason: impl Fn(usize) -> String) -> CallResult {
    if numbers.len() != values.len() {
        return Err(wrong_count(what, numbers.len(), values.len()));
    }
    if let Some(k) = numbers.iter().position(|x| !x.is_finite()) {
        return Err(CallError::discard(reason(k)));
    }
    numbers.iter().zip(values.iter()).for_each(|(number, value)| value.write(*number));
    Ok(())
}

/// Returns the error of a count that differs from the model description.
fn wrong_count(what: &str, expected: usize, found: usize) -> CallError {
    CallError::error(format!("there are {expected} {what}, not {found}"))
}

/// Number of event indicators.
pub const EVENT_INDICATORS: usize = INDICATORS;

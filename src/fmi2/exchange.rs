//! Model exchange: the host's solver moves the state, the instance tells rates and events.

use std::mem::MaybeUninit;

use super::calls::Phase;
use super::instance::Instance;
use super::refusal::{Answer, Refusal};
use super::types::{EventInfo, Kind};
use crate::model::{INDICATORS, STATES, Simulation, StepFailure};
use crate::variables::table;

impl Instance {
    /// The simulation of an instance that was made for model exchange.
    fn exchanged(&mut self) -> Answer<&mut Simulation> {
        if self.now.kind != Kind::ModelExchange {
            return Err(Refusal::error("this instance was made for co-simulation, the call is for model exchange"));
        }
        self.simulation()
    }

    /// fmi2EnterEventMode.
    pub fn enter_event_mode(&mut self) -> Answer {
        self.now.phase = Phase::Event;
        Ok(())
    }

    /// fmi2EnterContinuousTimeMode.
    pub fn enter_continuous_time_mode(&mut self) -> Answer {
        self.now.phase = Phase::ContinuousTime;
        Ok(())
    }

    /// fmi2NewDiscreteStates: one iteration is always enough.
    pub fn new_discrete_states(&mut self) -> Answer<EventInfo> {
        let update = self.exchanged()?.update();
        let update = self.lasting(update)?;
        Ok(EventInfo {
            states_changed: i32::from(update.states_changed),
            next_event_defined: i32::from(update.next.is_some()),
            next_event: update.next.unwrap_or(0.0),
            ..EventInfo::default()
        })
    }

    /// fmi2CompletedIntegratorStep. Whether an event is due.
    pub fn completed_integrator_step(&mut self) -> Answer<bool> {
        let outcome = self.exchanged()?.complete_step();
        let due = self.lasting(outcome)?;
        if self.now.simulation.as_ref().is_some_and(Simulation::is_watched) {
            self.watch();
        }
        Ok(due)
    }

    /// What came of taking note of a step: after a failure there is nothing to go on from.
    fn lasting<T>(&mut self, outcome: Result<T, StepFailure>) -> Answer<T> {
        let failure = match outcome {
            // wrapping positions and booking energies may overflow where the states themselves did not
            Ok(result) if self.now.simulation.as_ref().is_some_and(|s| s.state().is_valid()) => return Ok(result),
            Ok(_) => "the step ends at states with which no simulation can go on".to_owned(),
            Err(failure) => failure.to_string(),
        };
        self.now.phase = Phase::Error;
        Err(Refusal::error(format!("{failure}; go on with fmi2SetFMUstate or fmi2Reset")))
    }

    /// fmi2SetTime.
    pub fn set_time(&mut self, time: f64) -> Answer {
        if !time.is_finite() {
            return Err(Refusal::error(format!("time {time} s is not a finite number")));
        }
        self.exchanged()?.set_time(time);
        Ok(())
    }

    /// fmi2SetContinuousStates.
    pub fn set_continuous_states(&mut self, values: &[f64]) -> Answer {
        let states: &[f64; STATES] = values.try_into().map_err(|_| wrong_count("states", STATES, values.len()))?;
        if let Some(k) = states.iter().position(|x| !x.is_finite()) {
            let name = table().rows[table().states[k]].name;
            return Err(Refusal::discard(format!("{name} = {} is not a finite number", states[k])));
        }
        self.exchanged()?.set_states(states);
        Ok(())
    }

    /// fmi2GetContinuousStates.
    pub fn get_continuous_states(&mut self, values: &mut [MaybeUninit<f64>]) -> Answer {
        let states = self.exchanged()?.states();
        check_count("states", STATES, values.len())?;
        if let Some(k) = states.iter().position(|x| !x.is_finite()) {
            let name = table().rows[table().states[k]].name;
            return Err(Refusal::discard(format!("{name} is not a finite number")));
        }
        fill(&states, values);
        Ok(())
    }

    /// fmi2GetDerivatives.
    pub fn get_derivatives(&mut self, values: &mut [MaybeUninit<f64>]) -> Answer {
        let rates = self.exchanged()?.state_rates();
        check_count("derivatives", STATES, values.len())?;
        if let Some(k) = rates.iter().position(|x| !x.is_finite()) {
            let name = table().rows[table().derivatives[k]].name;
            return Err(Refusal::discard(format!(
                "{name} is not a finite number at these states; take a shorter step, or look at the inputs"
            )));
        }
        fill(&rates, values);
        Ok(())
    }

    /// fmi2GetEventIndicators.
    pub fn get_event_indicators(&mut self, values: &mut [MaybeUninit<f64>]) -> Answer {
        let indicators = self.exchanged()?.indicators();
        check_count("event indicators", INDICATORS, values.len())?;
        if let Some(k) = indicators.iter().position(|x| !x.is_finite()) {
            return Err(Refusal::discard(format!(
                "event indicator {k} is not a finite number at these states; take a shorter step, or look at the inputs"
            )));
        }
        fill(&indicators, values);
        Ok(())
    }

    /// fmi2GetNominalsOfContinuousStates.
    pub fn get_nominals(&mut self, values: &mut [MaybeUninit<f64>]) -> Answer {
        if self.now.kind != Kind::ModelExchange {
            return Err(Refusal::error("this instance was made for co-simulation, the call is for model exchange"));
        }
        let nominals = table().states.map(|i| table().rows[i].nominal.unwrap_or(1.0));
        check_count("nominals", STATES, values.len())?;
        fill(&nominals, values);
        Ok(())
    }
}

/// Hands `numbers` out; the host has room for just as many.
fn fill(numbers: &[f64], values: &mut [MaybeUninit<f64>]) {
    for (number, value) in numbers.iter().zip(values) {
        value.write(*number);
    }
}

/// Refuses a count that is not what stands in the model description, whatever else is wrong.
fn check_count(what: &str, has: usize, asked: usize) -> Answer {
    if has == asked { Ok(()) } else { Err(wrong_count(what, has, asked)) }
}

fn wrong_count(what: &str, has: usize, asked: usize) -> Refusal {
    Refusal::error(format!("there are {has} {what}, not {asked}"))
}

/// How many event indicators there are.
pub const EVENT_INDICATORS: usize = INDICATORS;

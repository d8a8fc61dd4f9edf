//! Reading and setting variables by value reference. A call that sets values checks all of them before it sets any.

use super::exchange::check_state;
use super::instance::is_tolerance;
use super::{CallError, CallResult, InputArray, Instance, Kind, Output, Phase};
use crate::model::{LedgerReadings, Motion, STATES, Simulation};
use crate::variables::{Access, EnumType, OutputSource, Variability, Variable, accepted, table, tuned};

/// FMI type of a variable, as used in the names of FMI functions.
fn type_name(row: &Variable) -> &'static str {
    match row.access {
        Access::Enumeration(..) | Access::Output(OutputSource::Choice(..)) => "Enumeration, read and set as Integer",
        Access::Real(_) | Access::Input(_) | Access::Output(_) => "Real",
        Access::Integer(_) => "Integer",
        Access::Boolean(_) => "Boolean",
    }
}

/// Returns the row of a value reference.
pub fn row(reference: u32) -> CallResult<&'static Variable> {
    let rows = &table().rows;
    usize::try_from(reference).ok().and_then(|i| rows.get(i)).ok_or_else(|| {
        CallError::error(format!(
            "value reference {reference} does not exist; the references are 0 to {}",
            rows.len() - 1
        ))
    })
}

/// Returns the error of a call for another type.
pub fn wrong_type(row: &Variable) -> CallError {
    CallError::error(format!("{} is of type {}", row.name, type_name(row)))
}

/// Returns the error of any String access, because there are no String variables.
pub fn string_error(reference: u32) -> CallError {
    row(reference).map_or_else(|error| error, wrong_type)
}

/// Returns `number` if it is finite. The host's solver may try states at which a variable has no finite value.
pub fn finite(row: &Variable, number: f64) -> CallResult<f64> {
    if number.is_finite() {
        return Ok(number);
    }
    Err(CallError::discard(format!(
        "{} is {number}, not a finite number, at these states; take a shorter step or check the inputs",
        row.name
    )))
}

/// Returns the error of setting a variable to `value`. If the value is not finite, the message also names the range.
fn value_error(row: &Variable, value: f64, problem: String) -> CallError {
    let Some(range) = row.range.filter(|_| !value.is_finite()) else { return CallError::discard(problem) };
    let unit = row.unit.map_or("", |u| u.name);
    CallError::discard(format!("{problem}; the range is [{}, {}] {unit}", range.min, range.max))
}

/// Returns the error of setting an output.
fn output_error(reference: u32, row: &Variable) -> CallError {
    let name = row.name;
    CallError::error(if row.variability == Variability::Fixed {
        format!("{name} is calculated from other parameters and cannot be set")
    } else if table().state(reference).is_some() {
        format!(
            "{name} is an output and cannot be set now: a continuous state can be set in model exchange, in continuous-time mode"
        )
    } else {
        format!("{name} is an output and cannot be set")
    })
}

fn choice_error(row: &Variable, kind: &EnumType, value: i32) -> CallError {
    let choices: Vec<_> = kind.choices.iter().map(|c| format!("{} = {}", c.value, c.name)).collect();
    CallError::error(format!("{}: {value} is not one of {}", row.name, choices.join(", ")))
}

/// Adds to an error of a call with `count` values that none of them was set.
pub fn all_or_none(count: usize, outcome: CallResult) -> CallResult {
    outcome.map_err(|error| match count {
        0 | 1 => error,
        _ => CallError {
            message: format!("{}; none of the {count} values of this call was set", error.message),
            ..error
        },
    })
}

impl Instance {
    /// Reads real variables. Computes only what the requested variables need, and shared quantities only once.
    pub fn get_real<'a>(
        &mut self,
        references: impl Iterator<Item = u32>,
        values: impl Iterator<Item = Output<'a, f64>>,
    ) -> CallResult {
        let mut motion: Option<Motion> = None;
        let mut ledger: Option<LedgerReadings> = None;
        let (mut pairs, mut states, mut rates) = (None, None, None);
        for (reference, value) in references.zip(values) {
            let row = row(reference)?;
            let number = match row.access {
                Access::Real(slot) => *slot(&mut self.now.parameters),
                Access::Input(slot) => *slot(&mut self.now.inputs),
                Access::Output(source) => {
                    let simulation = self.started(row)?;
                    match source {
                        OutputSource::Constant(i, of) => of(simulation, i),
                        OutputSource::Motion(i, of) => of(motion.get_or_insert_with(|| simulation.motion()), i),
                        OutputSource::Forces(i, of) => of(simulation.forces_without_components(), i),
                        OutputSource::Components(i, of) => of(simulation.forces(), i),
                        OutputSource::Pair(k, of) => of(&pairs.get_or_insert_with(|| simulation.pair_lines())[k]),
                        OutputSource::Reading(index) => simulation.forces_without_components().readings[index],
                        OutputSource::Ledger(i, of) => of(ledger.get_or_insert_with(|| simulation.ledger()), i),
                        OutputSource::Choice(..) => return Err(wrong_type(row)),
                        OutputSource::State(k) => states.get_or_insert_with(|| simulation.states())[k],
                        OutputSource::Rate(k) => rates.get_or_insert_with(|| simulation.state_rates())[k],
                    }
                }
                _ => return Err(wrong_type(row)),
            };
            value.write(finite(row, number)?);
        }
        Ok(())
    }

    /// Returns the simulation from which the output `row` is read.
    fn started(&mut self, row: &Variable) -> CallResult<&mut Simulation> {
        self.simulation().map_err(|e| CallError { message: format!("{}: {}", row.name, e.message), ..e })
    }

    /// Reads an integer or enumeration.
    pub fn get_integer(&mut self, reference: u32) -> CallResult<i32> {
        let row = row(reference)?;
        match row.access {
            Access::Integer(slot) => Ok(*slot(&mut self.now.parameters)),
            Access::Enumeration(_, get, _) => Ok(get(&self.now.parameters)),
            Access::Output(source @ OutputSource::Choice(..)) => Ok(source.read(self.started(row)?) as i32),
            _ => Err(wrong_type(row)),
        }
    }

    /// Reads a boolean.
    pub fn get_boolean(&mut self, reference: u32) -> CallResult<bool> {
        let row = row(reference)?;
        let Access::Boolean(slot) = row.access else { return Err(wrong_type(row)) };
        Ok(*slot(&mut self.now.parameters))
    }

    /// Sets real variables, and continuous states that the host integrates.
    pub fn set_real(&mut self, references: InputArray<u32>, values: InputArray<f64>) -> CallResult {
        // a single value needs no check of other values before it is set
        let is_checked = references.len() != 1 || self.now.kind == Kind::ModelExchange;
        let mut states = None;
        if is_checked {
            for (reference, value) in references.iter().zip(values.iter()) {
                self.accepted_real(reference, value, false)?;
            }
            states = self.with_states_set(references, values)?;
        }
        let mut tuned = false;
        for (reference, value) in references.iter().zip(values.iter()) {
            let row = row(reference)?;
            let value = self.accepted_real(reference, value, is_checked)?;
            let now = &mut self.now;
            match row.access {
                Access::Real(slot) => {
                    *slot(&mut now.parameters) = value;
                    now.tolerance_chosen |= is_tolerance(row);
                    tuned = true;
                }
                Access::Input(slot) => *slot(&mut now.inputs) = value,
                _ => continue,
            }
            now.set.insert(reference as usize);
        }
        self.end_derivatives_of(references);
        self.changed(tuned);
        if let Some(states) = states {
            self.move_to_states(&states)?;
        }
        for (reference, value) in references.iter().zip(values.iter()) {
            self.warn_of_set_value(reference, value);
        }
        Ok(())
    }

    /// Returns all states, in which those among the references have their new values. Returns `None` if there are no
    /// states among them.
    fn with_states_set(
        &mut self,
        references: InputArray<u32>,
        values: InputArray<f64>,
    ) -> CallResult<Option<[f64; STATES]>> {
        let mut states = None;
        for (reference, value) in references.iter().zip(values.iter()) {
            // other outputs have already been refused
            if let (Access::Output(_), Some(k)) = (row(reference)?.access, table().state(reference)) {
                if states.is_none() {
                    states = Some(self.simulation()?.states());
                }
                states.iter_mut().for_each(|states| states[k] = value);
            }
        }
        Ok(states)
    }

    /// Sets integers and enumerations.
    pub fn set_integer(&mut self, pairs: impl Iterator<Item = (u32, i32)> + Clone) -> CallResult {
        for (reference, value) in pairs.clone() {
            let row = row(reference)?;
            match row.access {
                Access::Enumeration(kind, ..) if kind.choices.iter().all(|c| c.value != value) => {
                    return Err(choice_error(row, kind, value));
                }
                Access::Integer(_) | Access::Enumeration(..) => self.check_settable(row)?,
                Access::Output(OutputSource::Choice(..)) => return Err(output_error(reference, row)),
                _ => return Err(wrong_type(row)),
            }
        }
        for (reference, value) in pairs {
            self.now.set.insert(reference as usize);
            match row(reference)?.access {
                Access::Integer(slot) => *slot(&mut self.now.parameters) = value,
                Access::Enumeration(_, _, set) => set(&mut self.now.parameters, value),
                _ => {}
            }
        }
        self.changed(true);
        Ok(())
    }

    /// Sets booleans.
    pub fn set_boolean(&mut self, pairs: impl Iterator<Item = (u32, bool)> + Clone) -> CallResult {
        for (reference, _) in pairs.clone() {
            let row = row(reference)?;
            let Access::Boolean(_) = row.access else { return Err(wrong_type(row)) };
            self.check_settable(row)?;
        }
        for (reference, value) in pairs {
            self.now.set.insert(reference as usize);
            if let Access::Boolean(slot) = row(reference)?.access {
                *slot(&mut self.now.parameters) = value;
            }
        }
        self.changed(true);
        Ok(())
    }

    /// Returns the value that a variable takes if it is set to `value`. Ranges of inputs are checked immediately, but
    /// ranges of parameters only in a running simulation. Before that, parameters must be finite, and initialisation
    /// checks all their ranges together. With `is_checked`, the value has passed this check before. It then exceeds its
    /// range at most by rounding and is set to the limit, even if one call sets its variable several times.
    fn accepted_real(&mut self, reference: u32, value: f64, is_checked: bool) -> CallResult<f64> {
        let row = row(reference)?;
        let (last, at_once) = match row.access {
            Access::Input(slot) => (*slot(&mut self.now.inputs), true),
            Access::Real(slot) => {
                self.check_settable(row)?;
                (*slot(&mut self.now.parameters), self.now.phase.is_running() || !value.is_finite())
            }
            Access::Output(_) if self.may_set_state(reference) => {
                check_state(row, value)?;
                return Ok(value);
            }
            Access::Output(_) => return Err(output_error(reference, row)),
            _ => return Err(wrong_type(row)),
        };
        let last = if is_checked && at_once { f64::INFINITY } else { last };
        match accepted(row, value, last) {
            Err(problem) if at_once => Err(value_error(row, value, problem.to_string())),
            taken => Ok(taken.unwrap_or(value)),
        }
    }

    /// Refuses a parameter that cannot be set now.
    fn check_settable(&self, row: &Variable) -> CallResult {
        match row.variability {
            Variability::Tunable if self.now.phase == Phase::ContinuousTime => Err(CallError::error(format!(
                "{} is a parameter: it cannot be set between events, enter event mode first",
                row.name
            ))),
            Variability::Fixed if self.now.phase.is_running() => Err(CallError::error(format!(
                "{} is a fixed parameter: it can be set only before {}",
                row.name, self.interface.exit_initialization
            ))),
            _ => Ok(()),
        }
    }

    /// Passes the new values to a running simulation. Before the start, the simulation is discarded and rebuilt on
    /// demand.
    fn changed(&mut self, parameters: bool) {
        let now = &mut self.now;
        if !now.phase.is_running() {
            now.simulation = None;
            return;
        }
        now.pass_inputs();
        if let Some(simulation) = &mut now.simulation {
            if parameters {
                simulation.tune(&tuned(&now.parameters, simulation.parameters()));
            }
            if simulation.is_model_exchange() {
                simulation.follow_commands();
            }
        }
    }
}

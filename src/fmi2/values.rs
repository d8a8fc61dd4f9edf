//! Getting and setting variables by value reference. A set call is checked as a whole, then carried out as a whole.

use std::mem::MaybeUninit;

use super::calls::Phase;
use super::instance::{Instance, is_tolerance};
use super::refusal::{Answer, Refusal};
use crate::model::{Books, Motion};
use crate::variables::{Access, EnumType, OutputSource, Variability, Variable, check_value, table, tuned};

/// FMI type of a variable, as FMI's functions name it.
fn type_name(row: &Variable) -> &'static str {
    match row.access {
        Access::Real(_) | Access::Input(_) | Access::Output(_) => "Real",
        Access::Integer(_) => "Integer",
        Access::Enumeration(..) => "Enumeration, read and set as Integer",
        Access::Boolean(_) => "Boolean",
    }
}

/// The row of a value reference.
pub fn row(reference: u32) -> Answer<&'static Variable> {
    let rows = &table().rows;
    usize::try_from(reference).ok().and_then(|i| rows.get(i)).ok_or_else(|| {
        Refusal::error(format!("value reference {reference} does not exist; they go from 0 to {}", rows.len() - 1))
    })
}

/// Refuses a call for another type.
pub fn wrong_type(row: &Variable) -> Refusal {
    Refusal::error(format!("{} is of type {}", row.name, type_name(row)))
}

/// Refuses any String access: there are no String variables.
pub fn refuse_string(reference: u32) -> Refusal {
    row(reference).map_or_else(|refusal| refusal, wrong_type)
}

/// `number` if it is one that a host can go on with: a solver of the host's may try states that have no answer.
pub fn finite(row: &Variable, number: f64) -> Answer<f64> {
    if number.is_finite() {
        return Ok(number);
    }
    Err(Refusal::discard(format!(
        "{} is {number}, not a finite number, at these states; take a shorter step, or look at the inputs",
        row.name
    )))
}

/// `problem` of a single value, with unit and range of its variable.
fn refused_value(row: &Variable, value: f64, problem: String) -> Refusal {
    let Some(range) = row.range.filter(|_| !value.is_finite()) else { return Refusal::discard(problem) };
    let unit = row.unit.map_or("", |u| u.name);
    Refusal::discard(format!("{problem}; allowed is [{}, {}] {unit}", range.min, range.max))
}

fn no_choice(row: &Variable, kind: &EnumType, value: i32) -> Refusal {
    let choices: Vec<_> = kind.choices.iter().map(|c| format!("{} = {}", c.value, c.name)).collect();
    Refusal::error(format!("{}: {value} is none of {}", row.name, choices.join(", ")))
}

impl Instance {
    /// fmi2GetReal. What several outputs share is computed once, and nothing that is not asked for.
    pub fn get_real(&mut self, references: &[u32], values: &mut [MaybeUninit<f64>]) -> Answer {
        let mut motion: Option<Motion> = None;
        let mut books: Option<Books> = None;
        let (mut states, mut rates) = (None, None);
        for (&reference, value) in references.iter().zip(values) {
            let row = row(reference)?;
            let number = match row.access {
                Access::Real(slot) => *slot(&mut self.now.parameters),
                Access::Input(slot) => *slot(&mut self.now.inputs),
                Access::Output(source) => {
                    let simulation = self
                        .simulation()
                        .map_err(|r| Refusal { message: format!("{}: {}", row.name, r.message), ..r })?;
                    match source {
                        OutputSource::Motion(of) => of(motion.get_or_insert_with(|| simulation.motion())),
                        OutputSource::Forces(of) => of(simulation.forces()),
                        OutputSource::Reading(place) => simulation.forces().readings[place],
                        OutputSource::Books(of) => of(books.get_or_insert_with(|| simulation.books())),
                        OutputSource::LedgerReading(place) => {
                            books.get_or_insert_with(|| simulation.books()).readings[place]
                        }
                        OutputSource::Heat(place) => books.get_or_insert_with(|| simulation.books()).heat[place],
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

    /// fmi2GetInteger; enumerations too.
    pub fn get_integer(&mut self, references: &[u32], values: &mut [MaybeUninit<i32>]) -> Answer {
        for (&reference, value) in references.iter().zip(values) {
            let row = row(reference)?;
            value.write(match row.access {
                Access::Integer(slot) => *slot(&mut self.now.parameters),
                Access::Enumeration(_, get, _) => get(&self.now.parameters),
                _ => return Err(wrong_type(row)),
            });
        }
        Ok(())
    }

    /// fmi2GetBoolean.
    pub fn get_boolean(&mut self, references: &[u32], values: &mut [MaybeUninit<i32>]) -> Answer {
        for (&reference, value) in references.iter().zip(values) {
            let row = row(reference)?;
            let Access::Boolean(slot) = row.access else { return Err(wrong_type(row)) };
            value.write(i32::from(*slot(&mut self.now.parameters)));
        }
        Ok(())
    }

    /// fmi2SetReal.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Answer {
        for (&reference, &value) in references.iter().zip(values) {
            self.check_real(row(reference)?, value)?;
        }
        let now = &mut self.now;
        let mut tuned = false;
        for (&reference, &value) in references.iter().zip(values) {
            let row = row(reference)?;
            match row.access {
                Access::Real(slot) => {
                    *slot(&mut now.parameters) = value;
                    now.tolerance_chosen |= is_tolerance(row);
                    tuned = true;
                }
                Access::Input(slot) => *slot(&mut now.inputs) = value,
                _ => {}
            }
        }
        self.end_derivatives_of(references);
        self.changed(tuned);
        Ok(())
    }

    /// fmi2SetInteger; enumerations too.
    pub fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Answer {
        for (&reference, &value) in references.iter().zip(values) {
            let row = row(reference)?;
            match row.access {
                Access::Enumeration(kind, ..) if kind.choices.iter().all(|c| c.value != value) => {
                    return Err(no_choice(row, kind, value));
                }
                Access::Integer(_) | Access::Enumeration(..) => self.check_settable(row)?,
                _ => return Err(wrong_type(row)),
            }
        }
        for (&reference, &value) in references.iter().zip(values) {
            match row(reference)?.access {
                Access::Integer(slot) => *slot(&mut self.now.parameters) = value,
                Access::Enumeration(_, _, set) => set(&mut self.now.parameters, value),
                _ => {}
            }
        }
        self.changed(true);
        Ok(())
    }

    /// fmi2SetBoolean; any value but 0 is true.
    pub fn set_boolean(&mut self, references: &[u32], values: &[i32]) -> Answer {
        for &reference in references {
            let row = row(reference)?;
            let Access::Boolean(_) = row.access else { return Err(wrong_type(row)) };
            self.check_settable(row)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            if let Access::Boolean(slot) = row(reference)?.access {
                *slot(&mut self.now.parameters) = value != 0;
            }
        }
        self.changed(true);
        Ok(())
    }

    /// Inputs are checked against their range at once; parameters too once the simulation runs, before only for being
    /// numbers, since their ranges are checked together when initialisation ends.
    fn check_real(&self, row: &Variable, value: f64) -> Answer {
        let at_once = match row.access {
            Access::Input(_) => true,
            Access::Real(_) | Access::Output(_) => {
                self.check_settable(row)?;
                self.now.phase.is_running() || !value.is_finite()
            }
            _ => return Err(wrong_type(row)),
        };
        match check_value(row, value) {
            Err(problem) if at_once => Err(refused_value(row, value, problem.to_string())),
            _ => Ok(()),
        }
    }

    fn check_settable(&self, row: &Variable) -> Answer {
        match (row.access, row.variability) {
            (Access::Output(_), _) => Err(Refusal::error(format!("{} is an output and cannot be set", row.name))),
            (_, Variability::Tunable) if self.now.phase == Phase::ContinuousTime => Err(Refusal::error(format!(
                "{} is a parameter: between events it cannot be set, enter event mode first",
                row.name
            ))),
            (_, Variability::Fixed) if self.now.phase.is_running() => Err(Refusal::error(format!(
                "{} is a fixed parameter: it can be set only before fmi2ExitInitializationMode",
                row.name
            ))),
            _ => Ok(()),
        }
    }

    /// Hands what was set to the simulation; before the first step it is built anew when it is asked for.
    fn changed(&mut self, parameters: bool) {
        let now = &mut self.now;
        match &mut now.simulation {
            Some(simulation) if now.phase.is_running() => {
                simulation.set_inputs(&now.inputs);
                if parameters {
                    simulation.tune(&tuned(&now.parameters, simulation.parameters()));
                }
                if simulation.is_handed_over() {
                    simulation.follow_commands();
                }
            }
            _ => now.simulation = None,
        }
    }
}

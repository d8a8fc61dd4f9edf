//! Look-up of variables by name, and assignment of their values.

use super::table::{accepted, check_value, table};
use super::{Access, Variable};
use crate::model::{Inputs, Parameters};
use crate::problem::Problem;

/// Index of the variable `name` in the table, which is its value reference in FMI 2.0.
pub fn index_of(name: &str) -> Option<usize> {
    table().rows.iter().position(|row| row.name == name)
}

/// Returns the variable `name`, if it exists.
pub fn named(name: &str) -> Option<&'static Variable> {
    table().rows.iter().find(|row| row.name == name)
}

/// Sets a parameter or an input. Numbers are in the unit of the interface, true and false are 1 and 0, and choices have
/// their numbers.
pub fn assign(row: &Variable, value: f64, parameters: &mut Parameters, inputs: &mut Inputs) -> Result<(), Problem> {
    let mut value = value;
    let wrong = |what: &str| Err(problem!(row.name, "{value} {what}"));
    let whole = value == libm::trunc(value) && value.abs() <= f64::from(i32::MAX);
    match row.access {
        Access::Output(_) => return Err(Problem::new(row.name, "it is an output and cannot be set")),
        Access::Integer(_) if !whole => return wrong("is not a whole number"),
        Access::Boolean(_) if value != 0.0 && value != 1.0 => return wrong("is neither 0 (false) nor 1 (true)"),
        Access::Enumeration(kind, ..) if !whole || kind.choices.iter().all(|one| one.value != value as i32) => {
            return wrong(&format!("is not one of the choices {}", choices(row)));
        }
        Access::Enumeration(..) | Access::Boolean(_) => {}
        Access::Integer(_) => check_value(row, value)?,
        Access::Real(slot) => value = accepted(row, value, *slot(parameters))?,
        Access::Input(slot) => value = accepted(row, value, *slot(inputs))?,
    }
    match row.access {
        Access::Real(slot) => *slot(parameters) = value,
        Access::Integer(slot) => *slot(parameters) = value as i32,
        Access::Boolean(slot) => *slot(parameters) = value != 0.0,
        Access::Enumeration(_, _, set) => set(parameters, value as i32),
        Access::Input(slot) => *slot(inputs) = value,
        Access::Output(_) => {}
    }
    Ok(())
}

/// Returns the number for the name of a choice, or for true or false.
pub fn number_of(row: &Variable, text: &str) -> Result<f64, Problem> {
    let found = match row.access {
        Access::Enumeration(kind, ..) => {
            kind.choices.iter().find(|one| one.name == text).map(|one| f64::from(one.value))
        }
        Access::Boolean(_) => text.parse::<bool>().ok().map(|truth| f64::from(u8::from(truth))),
        _ => return Err(problem!(row.name, "\"{text}\" is not a number, and this variable has no choices")),
    };
    found.ok_or_else(|| problem!(row.name, "\"{text}\" is not one of {}", choices(row)))
}

/// Returns the names to which a variable can be set.
fn choices(row: &Variable) -> String {
    match row.access {
        Access::Enumeration(kind, ..) => {
            kind.choices.iter().map(|one| format!("{} ({})", one.name, one.value)).collect::<Vec<_>>().join(", ")
        }
        _ => "true, false".to_owned(),
    }
}

/// Returns the value of a parameter or an input, or `None` for an output.
pub fn value_of(row: &Variable, parameters: &Parameters, inputs: &Inputs) -> Option<f64> {
    number(row, &mut { *parameters }, &mut { *inputs })
}

/// Returns the value of a parameter or an input, like [`value_of`]. It is faster for many variables, because the
/// mutable access of the table then needs no copies.
pub fn number(row: &Variable, parameters: &mut Parameters, inputs: &mut Inputs) -> Option<f64> {
    Some(match row.access {
        Access::Real(slot) => *slot(parameters),
        Access::Integer(slot) => f64::from(*slot(parameters)),
        Access::Boolean(slot) => f64::from(*slot(parameters)),
        Access::Enumeration(_, get, _) => f64::from(get(parameters)),
        Access::Input(slot) => *slot(inputs),
        Access::Output(_) => return None,
    })
}

//! Value of a variable from a file: it is checked and assigned with the table's accessor.

use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::{Access, Variability, Variable, accepted, assign, check_value, table, value_of};
use toml::Value;

use super::display_units::DisplayUnits;
use super::value::{self, written};
use super::{Scene, units};
use crate::problem::Problem;
use crate::text::near;

/// A variable with its value.
#[derive(Clone, Copy)]
pub struct Setting {
    /// Row of the variable.
    pub row: &'static Variable,
    /// The value.
    pub value: SettingValue,
}

/// Value of a variable, in the variable's type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SettingValue {
    /// A number in the unit of the interface.
    Real(f64),
    /// A whole number.
    Integer(i32),
    /// True or false.
    Boolean(bool),
    /// Literal of an enumeration, by its value.
    Literal(i32),
}

impl Setting {
    /// Checks `value` for the variable `name`. Fails with the problem of the value.
    pub fn new(name: &str, value: &Value) -> Result<Self, Problem> {
        let row = variable(name).map_err(|message| Problem { variable: Some(name.into()), ..message.into() })?;
        let problem = |what: String| {
            let written = written(value);
            let message = format!("{name} = {written}: {what}");
            Problem { hint: Problem::from(what).hint, ..Problem::of(name, written, message) }.about(row)
        };
        Ok(Self { row, value: known(row, value).map_err(problem)? })
    }

    /// Value of a parameter, or of an input at the start. Outputs have none.
    pub fn of(row: &'static Variable, parameters: &Parameters, inputs: &Inputs) -> Option<Self> {
        let number = value_of(row, parameters, inputs)?;
        let value = match row.access {
            Access::Real(_) | Access::Input(_) => SettingValue::Real(number),
            Access::Integer(_) => SettingValue::Integer(number as i32),
            Access::Boolean(_) => SettingValue::Boolean(number != 0.0),
            Access::Enumeration(..) => SettingValue::Literal(number as i32),
            Access::Output(_) => return None,
        };
        Some(Self { row, value })
    }

    /// True if the variable may be set while a simulation runs.
    pub fn may_come_later(&self) -> bool {
        self.row.variability != Variability::Fixed
    }

    /// Assigns the value.
    pub fn apply(&self, parameters: &mut Parameters, inputs: &mut Inputs) {
        let number = match self.value {
            SettingValue::Real(value) => value,
            SettingValue::Integer(value) | SettingValue::Literal(value) => f64::from(value),
            SettingValue::Boolean(value) => f64::from(u8::from(value)),
        };
        // `known` has checked that the value fits
        let fits = assign(self.row, number, parameters, inputs);
        debug_assert_eq!(fits, Ok(()));
    }

    /// Value for programs: a number in the unit of the interface, or the name of a literal.
    pub fn json(&self) -> serde_json::Value {
        match self.value {
            SettingValue::Real(number) => number.into(),
            SettingValue::Integer(number) => number.into(),
            SettingValue::Boolean(truth) => truth.into(),
            SettingValue::Literal(_) => self.text().into(),
        }
    }

    /// Value for readers, in the usual display unit.
    pub fn text(&self) -> String {
        self.text_in(&DisplayUnits::default())
    }

    /// Value for readers, in `display_units`.
    pub fn text_in(&self, display_units: &DisplayUnits) -> String {
        match self.value {
            SettingValue::Real(value) => units::text(&display_units.row(self.row), value),
            SettingValue::Integer(value) => value.to_string(),
            SettingValue::Boolean(value) => value.to_string(),
            SettingValue::Literal(value) => literal(self.row, value).map_or(String::new(), |(name, _)| name.to_owned()),
        }
    }
}

/// Returns the row of variable `name`. The error suggests similar names.
pub fn variable(name: &str) -> Result<&'static Variable, String> {
    let rows = &table().rows;
    let found = rows.iter().find(|row| row.name == name);
    found.ok_or_else(|| format!("there is no variable \"{name}\"{}", hint(name, rows.iter())))
}

/// Returns the row of the output or input `name`, which can be recorded. The error suggests similar names.
pub fn output(name: &str) -> Result<&'static Variable, String> {
    let is_output = |row: &&Variable| matches!(row.access, Access::Output(_) | Access::Input(_));
    let rows = &table().rows;
    match rows.iter().find(|row| row.name == name) {
        Some(row) if is_output(&row) => Ok(row),
        Some(_) => Err(format!("{name} is a parameter; outputs and inputs can be recorded")),
        None => Err(format!("there is no output \"{name}\"{}", hint(name, rows.iter().filter(is_output)))),
    }
}

/// Suggests similar names, or advises how to find one.
fn hint<'a>(name: &str, rows: impl Iterator<Item = &'a Variable>) -> String {
    let near = near::hint(name, rows.map(|row| row.name));
    if near.is_empty() { format!("; {}", how_to_find(name)) } else { near }
}

/// Advises how to find a variable, using those words of the wrong name that occur in variables.
pub fn how_to_find(name: &str) -> String {
    let has = |row: &Variable, word: &str| row.name.contains(word) || row.description.to_lowercase().contains(word);
    let mut kept: Vec<String> = Vec::new();
    for word in near::words(name).into_iter().rev().filter(|word| word.len() > 2) {
        let is_there = |row: &&Variable| has(row, &word) && kept.iter().all(|known| has(row, known));
        if table().rows.iter().any(|row| is_there(&row)) {
            kept.insert(0, word);
        }
    }
    let (words, which) = match kept.len() {
        0 => (String::new(), "all variables"),
        _ => (format!(" {}", kept.join(" ")), "those that may be meant"),
    };
    format!("`bevel-differential variables{words}` lists {which}")
}

/// Name and meaning of the enumeration literal `value`.
pub fn literal(row: &Variable, value: i32) -> Option<(&'static str, &'static str)> {
    let Access::Enumeration(kind, ..) = row.access else { return None };
    kind.choices.iter().find(|choice| choice.value == value).map(|choice| (choice.name, choice.description))
}

fn known(row: &'static Variable, value: &Value) -> Result<SettingValue, String> {
    match row.access {
        Access::Output(_) => Err("it is an output, which cannot be set; name it under outputs".into()),
        Access::Real(_) | Access::Input(_) => real(row, value).map(SettingValue::Real),
        Access::Integer(_) => {
            let number = value::whole(value)?;
            check_value(row, f64::from(number)).map_err(|problem| problem.message)?;
            Ok(SettingValue::Integer(number))
        }
        Access::Boolean(_) => value::truth(value).map(SettingValue::Boolean),
        Access::Enumeration(kind, ..) => {
            let choices: Vec<_> = kind.choices.iter().map(|choice| (choice.name, choice.value)).collect();
            value::literal(value, &choices).map(SettingValue::Literal)
        }
    }
}

/// Returns a real value in the unit of the interface. Fails if the value is unreadable or out of its range.
pub fn real(row: &'static Variable, value: &Value) -> Result<f64, String> {
    let number = value::real(value, row.unit.map(|unit| unit.name), row.unit.is_some_and(|unit| unit.is_relative))?;
    accepted(row, number, 0.0).map_err(|problem| {
        // a text with a unit needs no suggestion of another unit
        let message = match value {
            Value::String(_) => problem.message.split("; did you mean").next().unwrap_or_default().to_owned(),
            _ => problem.message,
        };
        match (row.display, row.range) {
            (Some(_), Some(range)) if range.only_value().is_none() => {
                format!("{message} ([{}, {}])", units::text(row, range.min), units::text(row, range.max))
            }
            _ => message,
        }
    })
}

/// Start values of `scene`, in the order of the FMU's variables: all inputs, and the parameters that the scene sets
/// explicitly or that differ from the default.
pub fn start_values(scene: &Scene) -> Vec<Setting> {
    let all = table().rows.iter();
    all.filter(|row| matches!(row.access, Access::Input(_)) || is_of_scene(scene, row))
        .filter_map(|row| Setting::of(row, &scene.parameters, &scene.inputs))
        .collect()
}

/// Start values of the parameters and inputs that `scene` sets explicitly or that differ from the default.
pub fn changed_values(scene: &Scene) -> Vec<Setting> {
    start_values(scene).into_iter().filter(|setting| is_of_scene(scene, setting.row)).collect()
}

/// True if `scene` sets a variable explicitly, or if the variable's value in `scene` differs from the default.
fn is_of_scene(scene: &Scene, row: &'static Variable) -> bool {
    let named = scene.settings.iter().any(|setting| setting.row.name == row.name);
    let value = |p: &Parameters, i: &Inputs| value_of(row, p, i);
    named || value(&scene.parameters, &scene.inputs) != value(&Parameters::default(), &Inputs::default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_settable_variable_accepts_its_own_start_value() {
        let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
        for row in table().rows {
            let value = match row.access {
                Access::Real(access) => Value::Float(*access(&mut parameters)),
                Access::Input(access) => Value::Float(*access(&mut inputs)),
                Access::Integer(access) => Value::Integer((*access(&mut parameters)).into()),
                Access::Boolean(access) => Value::Boolean(*access(&mut parameters)),
                Access::Enumeration(_, get, _) => {
                    let (name, _) = literal(row, get(&parameters)).expect("a literal");
                    Value::String(name.into())
                }
                Access::Output(_) => continue,
            };
            let setting = Setting::new(row.name, &value).expect(row.name);
            setting.apply(&mut parameters, &mut inputs);
        }
        assert_eq!((parameters, inputs), (Parameters::default(), Inputs::default()));
    }
}

//! Values as users write them.

use super::{Access, Variable};
use crate::model::six_digits;

/// Returns a value as users write it, with its unit.
pub(super) fn written(row: &Variable, value: f64) -> String {
    match row.access {
        Access::Enumeration(kind, ..) => {
            let choice = kind.choices.iter().find(|choice| f64::from(choice.value) == value);
            choice.map_or(String::new(), |choice| choice.name.to_owned())
        }
        Access::Boolean(_) => (value != 0.0).to_string(),
        _ => {
            let unit = row.unit.map_or("", |unit| if unit.name == "1" { "" } else { unit.name });
            format!("{value} {unit}").trim_end().to_owned()
        }
    }
}

/// Returns a value like [`written`], but in the display unit of `row`.
pub(super) fn written_as_shown(row: &Variable, value: f64) -> String {
    match (row.access, row.display) {
        (Access::Real(_) | Access::Input(_), Some(shown)) => {
            format!("{} {}", six_digits(shown.show(value)), shown.name)
        }
        (Access::Real(_) | Access::Input(_), None) => written(row, six_digits(value)),
        _ => written(row, value),
    }
}

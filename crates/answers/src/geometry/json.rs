//! The dimensions for a program: the rows of the table by key, in the table's order.

use anyhow::Result;
use bevel_differential::model::Parameters;
use bevel_differential::variables::{Access, Variable};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::design::{Design, parameters};
use super::dimensions::{Dimension, DimensionGroup, QuantityKind, of_gears, of_pair};
use super::interference::{InterferenceCheck, InterferenceReport};
use super::tredgold::{TredgoldComparison, comparisons};
use crate::scene::set::literal;

/// Entries of an object in the order they are given, which a map of the library would lose.
struct Ordered(Vec<(&'static str, JsonEntry)>);

#[derive(Serialize)]
#[serde(untagged)]
enum JsonEntry {
    Parameter {
        value: Value,
        #[serde(skip_serializing_if = "Option::is_none")]
        unit: Option<&'static str>,
    },
    Dimension {
        value: Value,
        unit: &'static str,
        symbol: &'static str,
        standard: Value,
        meaning: String,
    },
    TredgoldComparison {
        exact: f64,
        tredgold: f64,
        unit: &'static str,
        relative_error: Option<f64>,
    },
}

impl Serialize for Ordered {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}

#[derive(Serialize)]
struct Document {
    parameters: Ordered,
    planet: Ordered,
    side_gear: Ordered,
    pair: Ordered,
    tredgold: Ordered,
    #[serde(skip_serializing_if = "Option::is_none")]
    interference: Option<InterferenceReport>,
    warnings: Vec<Value>,
}

/// All of it, with what the check of interference found if it was made.
pub fn text(design: &Design, check: Option<&InterferenceCheck>) -> Result<String> {
    let mut values = design.parameters;
    let warnings = design.warnings.iter();
    let document = Document {
        parameters: Ordered(parameters().map(|row| (row.name, parameter(row, &mut values))).collect()),
        planet: dimensions(of_gears(), design, 0),
        side_gear: dimensions(of_gears(), design, 1),
        pair: dimensions(of_pair(), design, 0),
        tredgold: Ordered(comparisons(design).iter().map(|found| (found.key, comparison(found))).collect()),
        interference: check.map(InterferenceCheck::report),
        warnings: warnings.map(|found| json!({"variable": found.variable, "message": found.message})).collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

fn dimensions(groups: Vec<DimensionGroup>, design: &Design, i: usize) -> Ordered {
    Ordered(groups.iter().flat_map(|group| &group.rows).map(|row| (row.key, dimension(row, design, i))).collect())
}

fn dimension(row: &Dimension, design: &Design, i: usize) -> JsonEntry {
    let value = row.shown(design, i);
    JsonEntry::Dimension {
        // whole numbers without a decimal point
        value: if row.kind == QuantityKind::Count { Value::from(value as i64) } else { Value::from(value) },
        unit: row.kind.unit(),
        symbol: row.symbol,
        standard: row.standard.map_or(Value::Bool(false), Value::from),
        meaning: format!("{}: {}", row.term(), row.meaning),
    }
}

fn comparison(found: &TredgoldComparison) -> JsonEntry {
    let [exact, tredgold] = [found.exact, found.planar].map(|value| found.kind.shown(value));
    JsonEntry::TredgoldComparison { exact, tredgold, unit: found.kind.unit(), relative_error: found.error() }
}

/// A parameter as the FMU has it.
fn parameter(row: &Variable, values: &mut Parameters) -> JsonEntry {
    let value = match row.access {
        Access::Real(access) => Value::from(*access(values)),
        Access::Integer(access) => Value::from(*access(values)),
        Access::Boolean(access) => Value::from(*access(values)),
        Access::Enumeration(_, get, _) => Value::from(literal(row, get(values)).map(|(name, _)| name)),
        // what shapes the gears are parameters
        Access::Input(_) | Access::Output(_) => Value::Null,
    };
    let number = matches!(row.access, Access::Real(_) | Access::Integer(_));
    JsonEntry::Parameter { value, unit: number.then(|| row.unit.map_or("1", |unit| unit.name)) }
}

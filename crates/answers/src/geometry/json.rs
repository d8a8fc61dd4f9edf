//! JSON of the dimensions: the rows of the table by key, in the table's order.

use anyhow::Result;
use bevel_differential::model::Inputs;
use bevel_differential::problem::Problem;
use bevel_differential::variables::{Access, Variable};
use serde_json::{Value, json};

use super::design::{Design, parameters};
use super::dimensions::{Dimension, DimensionGroup, QuantityKind, of_gears, of_pair};
use super::interference::InterferenceCheck;
use super::tredgold::{TredgoldComparison, comparisons};
use crate::scene::set::Setting;

/// Complete JSON text, with the findings of the interference check if there is one.
pub fn text(design: &Design, check: Option<&InterferenceCheck>) -> Result<String> {
    let warning = |found: &Problem| json!({"message": found.message, "variable": found.variable});
    let mut document = json!({
        "parameters": parameters().map(|row| (row.name, parameter(design, row))).collect::<Value>(),
        "planet": dimensions(of_gears(), design, 0),
        "side_gear": dimensions(of_gears(), design, 1),
        "pair": dimensions(of_pair(), design, 0),
        "tredgold": comparisons(design).iter().map(|found| (found.key, comparison(found))).collect::<Value>(),
    });
    if let Some(check) = check {
        document["interference"] = check.report();
    }
    document["warnings"] = design.warnings.iter().map(warning).collect();
    document["remarks"] = design.remarks.iter().map(warning).collect();
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

fn dimensions(groups: Vec<DimensionGroup>, design: &Design, i: usize) -> Value {
    let rows = groups.iter().flat_map(|group| &group.rows);
    rows.map(|row| (row.key, dimension(row, design, i))).collect()
}

fn dimension(row: &Dimension, design: &Design, i: usize) -> Value {
    let value = row.shown(design, i);
    json!({
        // whole numbers without a decimal point
        "value": if row.kind == QuantityKind::Count { json!(value as i64) } else { json!(value) },
        "unit": row.kind.unit(),
        "symbol": row.symbol,
        "standard": row.standard.map_or(json!(false), Value::from),
        "meaning": format!("{}: {}", row.term(), row.meaning),
    })
}

fn comparison(found: &TredgoldComparison) -> Value {
    let [exact, tredgold] = [found.exact, found.planar].map(|value| found.kind.shown(value));
    json!({"exact": exact, "tredgold": tredgold, "unit": found.kind.unit(), "relative_error": found.error()})
}

/// Value of a parameter. Numbers also have their unit in the FMU.
fn parameter(design: &Design, row: &'static Variable) -> Value {
    // all variables of the geometry are parameters
    let setting = Setting::of(row, &design.parameters, &Inputs::default());
    let mut entries = json!({"value": setting.map(|setting| setting.json())});
    if matches!(row.access, Access::Real(_) | Access::Integer(_)) {
        entries["unit"] = row.unit.map_or("1", |unit| unit.name).into();
    }
    entries
}

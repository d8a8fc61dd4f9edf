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
use crate::text::ordered::Ordered;

/// Complete JSON text, with the findings of the interference check if there is one.
pub fn text(design: &Design, check: Option<&InterferenceCheck>) -> Result<String> {
    let parameter = |row: &'static Variable| (row.name, parameter(design, row));
    let comparison = |found: &TredgoldComparison| (found.key, comparison(found));
    let warning = |found: &Problem| json!({"variable": found.variable, "message": found.message});
    let mut document = vec![
        ("parameters", Ordered::Object(parameters().map(parameter).collect())),
        ("planet", dimensions(of_gears(), design, 0)),
        ("side_gear", dimensions(of_gears(), design, 1)),
        ("pair", dimensions(of_pair(), design, 0)),
        ("tredgold", Ordered::Object(comparisons(design).iter().map(comparison).collect())),
    ];
    document.extend(check.map(|check| ("interference", check.report())));
    document.push(("warnings", design.warnings.iter().map(warning).collect::<Value>().into()));
    document.push(("remarks", design.remarks.iter().map(warning).collect::<Value>().into()));
    Ok(serde_json::to_string_pretty(&Ordered::Object(document))? + "\n")
}

fn dimensions(groups: Vec<DimensionGroup>, design: &Design, i: usize) -> Ordered {
    let rows = groups.iter().flat_map(|group| &group.rows);
    Ordered::Object(rows.map(|row| (row.key, dimension(row, design, i))).collect())
}

fn dimension(row: &Dimension, design: &Design, i: usize) -> Ordered {
    let value = row.shown(design, i);
    Ordered::Object(vec![
        // whole numbers without a decimal point
        ("value", if row.kind == QuantityKind::Count { (value as i64).into() } else { value.into() }),
        ("unit", row.kind.unit().into()),
        ("symbol", row.symbol.into()),
        ("standard", row.standard.map_or(Value::Bool(false), Value::from).into()),
        ("meaning", format!("{}: {}", row.term(), row.meaning).into()),
    ])
}

fn comparison(found: &TredgoldComparison) -> Ordered {
    let [exact, tredgold] = [found.exact, found.planar].map(|value| found.kind.shown(value));
    Ordered::Object(vec![
        ("exact", exact.into()),
        ("tredgold", tredgold.into()),
        ("unit", found.kind.unit().into()),
        ("relative_error", found.error().into()),
    ])
}

/// Value of a parameter. Numbers also have their unit in the FMU.
fn parameter(design: &Design, row: &'static Variable) -> Ordered {
    // all variables of the geometry are parameters
    let setting = Setting::of(row, &design.parameters, &Inputs::default());
    let mut entries = vec![("value", setting.map_or(Value::Null, |setting| setting.json()).into())];
    if matches!(row.access, Access::Real(_) | Access::Integer(_)) {
        entries.push(("unit", row.unit.map_or("1", |unit| unit.name).into()));
    }
    Ordered::Object(entries)
}

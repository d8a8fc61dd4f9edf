//! What the page knows of the library: variables from the table, scenes from their files, prices of effects.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use bevel_differential::model::effects::Declared;
use bevel_differential::model::{EFFECTS, Inputs, Parameters};
use bevel_differential::variables::{Access, Variable, guid, table};
use serde::Serialize;

use crate::fmu::describe::{causality, variability};
use crate::tools::paths;
use answers::scene::set::{Setting, SettingValue};
use answers::scene::{self, Scene, load, units};

/// All of it; values are SI.
#[derive(Serialize)]
pub struct PageData {
    version: &'static str,
    guid: &'static str,
    variables: Vec<PageVariable>,
    scenes: Vec<PageScene>,
    prices: Vec<Price>,
}

#[derive(Serialize)]
struct PageVariable {
    name: &'static str,
    reference: usize,
    kind: &'static str,
    causality: &'static str,
    variability: &'static str,
    unit: Option<&'static str>,
    shown: &'static str,
    factor: f64,
    min: Option<f64>,
    max: Option<f64>,
    start: Option<Value>,
    description: &'static str,
    literals: Vec<Literal>,
    /// Switches of the effects that give the output; none where it is always there.
    switches: Vec<&'static str>,
}

#[derive(Serialize)]
struct Literal {
    name: &'static str,
    value: i32,
    description: &'static str,
}

/// A number, or whether something is on.
#[derive(Serialize)]
#[serde(untagged)]
enum Value {
    Real(f64),
    Integer(i32),
    Boolean(bool),
}

/// Values by the names of their variables.
type Values = BTreeMap<&'static str, Value>;

#[derive(Serialize)]
struct PageScene {
    name: String,
    description: String,
    stop: f64,
    step: f64,
    outputs: Vec<&'static str>,
    set: Values,
    changes: Vec<(f64, Values)>,
    tables: Vec<PageTable>,
}

#[derive(Serialize)]
struct PageTable {
    name: &'static str,
    times: Vec<f64>,
    values: Vec<f64>,
    period: Option<f64>,
}

/// What a switch costs, as a multiple of plain teeth.
#[derive(Serialize)]
struct Price {
    effect: &'static str,
    factor: f64,
}

/// What the page is made from.
pub fn data() -> Result<PageData> {
    let scenes =
        scene::files(&paths::scenes())?.iter().map(|file| load::load(file).map(page_scene)).collect::<Result<_>>()?;
    let variables = table().rows.iter().enumerate().map(|(reference, row)| page_variable(reference, row)).collect();
    Ok(PageData { version: env!("CARGO_PKG_VERSION"), guid: guid(), variables, scenes, prices: prices()? })
}

fn page_variable(reference: usize, row: &'static Variable) -> PageVariable {
    let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
    let (kind, start) = match row.access {
        Access::Real(field) => ("Real", Some(Value::Real(*field(&mut parameters)))),
        Access::Integer(field) => ("Integer", Some(Value::Integer(*field(&mut parameters)))),
        Access::Boolean(field) => ("Boolean", Some(Value::Boolean(*field(&mut parameters)))),
        Access::Enumeration(_, get, _) => ("Enumeration", Some(Value::Integer(get(&parameters)))),
        Access::Input(field) => ("Real", Some(Value::Real(*field(&mut inputs)))),
        Access::Output(_) => ("Real", None),
    };
    let choices = match row.access {
        Access::Enumeration(kind, ..) => kind.choices,
        _ => &[],
    };
    let literals = choices.iter().map(|choice| Literal {
        name: choice.name,
        value: choice.value,
        description: choice.description,
    });
    PageVariable {
        name: row.name,
        reference,
        kind,
        causality: causality(row),
        variability: variability(row),
        unit: row.unit.map(|unit| unit.name),
        shown: units::name(row),
        factor: row.display.map_or(1.0, |shown| shown.factor),
        min: row.range.map(|range| range.min),
        max: row.range.map(|range| range.max),
        start,
        description: row.description,
        literals: literals.collect(),
        switches: EFFECTS.iter().filter(|effect| gives(effect, row.name)).filter_map(|effect| effect.switch).collect(),
    }
}

/// Whether the effect brings the output.
fn gives(effect: &Declared, output: &str) -> bool {
    let heat = effect.heat.map(|heat| heat.output);
    heat.into_iter().chain(effect.readings.iter().map(|reading| reading.name)).any(|name| name == output)
}

fn page_scene(scene: Scene) -> PageScene {
    let table = |table: scene::InputTable| PageTable {
        name: table.row.name,
        times: table.times,
        values: table.values,
        period: table.period,
    };
    PageScene {
        name: scene.name,
        description: scene.description,
        stop: scene.stop_time,
        step: scene.step,
        outputs: scene.outputs.iter().map(|row| row.name).collect(),
        set: scene.settings.iter().map(assignment).collect(),
        changes: scene
            .events
            .iter()
            .map(|event| (event.time, event.settings.iter().map(assignment).collect()))
            .collect(),
        tables: scene.input_tables.into_iter().map(table).collect(),
    }
}

fn assignment(setting: &Setting) -> (&'static str, Value) {
    let value = match setting.value {
        SettingValue::Real(value) => Value::Real(value),
        SettingValue::Integer(value) | SettingValue::Literal(value) => Value::Integer(value),
        SettingValue::Boolean(value) => Value::Boolean(value),
    };
    (setting.row.name, value)
}

/// Price of a step with each effect alone over that of plain teeth, from the last measurement (docs/cost.md).
fn prices() -> Result<Vec<Price>> {
    let file = paths::workspace().join("crates").join("answers").join("data").join("prices.csv");
    let mut reader =
        csv::Reader::from_path(&file).with_context(|| format!("{} cannot be read", paths::shown(&file)))?;
    let rows: Vec<(String, f64, f64)> = reader.deserialize().collect::<Result<_, _>>().context("data/prices.csv")?;
    let plain = rows.iter().find(|(on, ..)| on == "nothing").context("data/prices.csv has no row \"nothing\"")?.2;
    let price = |(on, _, step): &(String, f64, f64)| {
        let switch = table().rows.iter().find(|row| row.name.strip_prefix("effects.") == Some(on))?;
        Some(Price { effect: switch.name, factor: step / plain })
    };
    Ok(rows.iter().filter_map(price).collect())
}

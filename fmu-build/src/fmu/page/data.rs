//! Data of the library for the page: variables from the table, scenes from their files, prices of effects.

use anyhow::{Context, Result};
use bevel_differential::model::effects::EffectEntry;
use bevel_differential::model::{EFFECTS, Inputs, Parameters};
use bevel_differential::variables::{Access, OutputSource, Variable, guid, table};
use serde_json::{Map, Value, json};

use crate::fmu::describe::{causality, variability};
use crate::tools::paths;
use answers::scene::set::{Setting, SettingValue};
use answers::scene::{self, InputTable, Scene, load, units};

/// Returns all data for the page; values are SI.
pub fn data() -> Result<Value> {
    let scenes: Vec<Value> =
        scene::files(&paths::scenes())?.iter().map(|file| load::load(file).map(of_scene)).collect::<Result<_>>()?;
    let variables: Vec<Value> = table().rows.iter().enumerate().map(|(index, row)| of_variable(index, row)).collect();
    Ok(json!({
        "version": env!("CARGO_PKG_VERSION"),
        "guid": guid(),
        "variables": variables,
        "scenes": scenes,
        "prices": prices()?,
    }))
}

fn of_variable(reference: usize, row: &'static Variable) -> Value {
    let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
    let (kind, start) = match row.access {
        Access::Real(field) => ("Real", json!(*field(&mut parameters))),
        Access::Integer(field) => ("Integer", json!(*field(&mut parameters))),
        Access::Boolean(field) => ("Boolean", json!(*field(&mut parameters))),
        Access::Enumeration(_, get, _) => ("Enumeration", json!(get(&parameters))),
        Access::Input(field) => ("Real", json!(*field(&mut inputs))),
        Access::Output(OutputSource::Choice(..)) => ("Enumeration", Value::Null),
        Access::Output(_) => ("Real", Value::Null),
    };
    let choices = row.access.enumeration().map_or(&[][..], |kind| kind.choices);
    let literals: Vec<Value> = choices
        .iter()
        .map(|choice| json!({"name": choice.name, "value": choice.value, "description": choice.description}))
        .collect();
    // switches of the effects that provide an output; none for outputs that are always present
    let switches = EFFECTS.iter().filter(|effect| gives(effect, row.name)).filter_map(|effect| effect.switch);
    json!({
        "name": row.name,
        "reference": reference,
        "kind": kind,
        "causality": causality(row),
        "variability": variability(row),
        "unit": row.unit.map(|unit| unit.name),
        "shown": units::name(row),
        "factor": row.display.map_or(1.0, |shown| shown.factor),
        "offset": row.display.map_or(0.0, |shown| shown.offset),
        "min": row.range.map(|range| range.min),
        "max": row.range.map(|range| range.max),
        "start": start,
        "description": row.description,
        "literals": literals,
        "switches": switches.collect::<Vec<_>>(),
    })
}

/// True if the effect provides the output.
fn gives(effect: &EffectEntry, output: &str) -> bool {
    let heat = effect.heat.map(|heat| heat.output);
    heat.into_iter().chain(effect.readings.iter().map(|reading| reading.name)).any(|name| name == output)
}

fn of_scene(scene: Scene) -> Value {
    let table = |InputTable { row, table }: &InputTable| json!({"name": row.name, "times": table.times, "values": table.values, "period": table.period});
    json!({
        "name": scene.name,
        "description": scene.description,
        "stop": scene.stop_time,
        "step": scene.step,
        "outputs": scene.outputs.iter().map(|row| row.name).collect::<Vec<_>>(),
        "set": assignments(&scene.settings),
        "changes": scene.events.iter().map(|event| json!([event.time, assignments(&event.settings)])).collect::<Vec<_>>(),
        "tables": scene.input_tables.iter().map(table).collect::<Vec<_>>(),
        "slopes": scene.input_slopes,
    })
}

/// Values by variable name.
fn assignments(settings: &[Setting]) -> Value {
    let value = |setting: &Setting| match setting.value {
        SettingValue::Real(value) => json!(value),
        SettingValue::Integer(value) | SettingValue::Literal(value) => json!(value),
        SettingValue::Boolean(value) => json!(value),
    };
    settings.iter().map(|setting| (setting.row.name.to_owned(), value(setting))).collect::<Map<_, _>>().into()
}

/// Cost of each single effect, relative to plain teeth, from the last measurement (docs/accuracy.md).
fn prices() -> Result<Vec<Value>> {
    let file = paths::workspace().join("crates").join("answers").join("data").join("prices.csv");
    let mut reader =
        csv::Reader::from_path(&file).with_context(|| format!("{} cannot be read", paths::shown(&file)))?;
    let rows: Vec<(String, f64, f64)> = reader.deserialize().collect::<Result<_, _>>().context("data/prices.csv")?;
    let plain = rows.iter().find(|(on, ..)| on == "nothing").context("data/prices.csv has no row \"nothing\"")?.2;
    let price = |(on, _, step): &(String, f64, f64)| {
        let switch = table().rows.iter().find(|row| row.name.strip_prefix("effects.") == Some(on))?;
        Some(json!({"effect": switch.name, "factor": step / plain}))
    };
    Ok(rows.iter().filter_map(price).collect())
}

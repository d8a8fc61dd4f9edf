//! A scene as a Python script that runs the FMU by fmpy: a body that is the same for all, with what the scene says in it.

use std::fmt::Write as _;

use anyhow::{Context, Result};

use super::set::{Setting, SettingValue};
use super::start_values::start_values;
use super::{InputTable, Scene, units};

/// The part that is the same for all scenes.
const BODY: &str = include_str!("../../../python/scene_body.py");
/// The line of it that the scene replaces.
const PLACE: &str = "# (the scene)\n";
/// Widest line of numbers.
const WIDTH: usize = 100;

/// The file's text.
pub fn text(scene: &Scene) -> Result<String> {
    let (imports, functions) = BODY.split_once(PLACE).context("the body of the script has no place for the scene")?;
    // quotes and backslashes would end the docstring or change in it
    let plain = |text: &str| text.replace('\\', "/").replace('"', "'");
    Ok(format!(
        "\"\"\"{}: {}\n\n\
         A scene of the bevel gear differential, simulated with its FMU. Written by the command `scene`; needs fmpy.\n\
         It records the same numbers, to the last bit, as `scene` with --csv.\n\"\"\"\n\n{imports}{}{functions}",
        plain(&scene.name),
        plain(&scene.description),
        data(scene)?
    ))
}

/// What the scene says, as constants.
fn data(scene: &Scene) -> Result<String> {
    let mut out = String::new();
    writeln!(out, "SCENE = {}", quoted(&scene.name)?)?;
    writeln!(out, "DESCRIPTION = {}", quoted(&scene.description)?)?;
    writeln!(out, "STOP_TIME = {:?}  # s", scene.stop_time)?;
    writeln!(out, "STEP = {:?}  # communication step, s", scene.step)?;
    writeln!(out, "# values before the start, in the units of the FMU; an enumeration by its number")?;
    writeln!(out, "START = {{\n{}}}", values("    ", &start_values(scene))?)?;
    writeln!(out, "# later values: time in s, then inputs and tunable parameters\nCHANGES = [")?;
    for event in &scene.events {
        writeln!(out, "    ({:?}, {{\n{}    }}),", event.time, values("        ", &event.settings)?)?;
    }
    writeln!(
        out,
        "]\n# inputs that go straight from point to point: times in s, values, and the period after which they repeat"
    )?;
    writeln!(out, "TABLES = {{")?;
    for table in tables(scene) {
        let period = table.period.map_or("None".into(), |period| format!("{period:?}"));
        writeln!(out, "    {}: ([\n{}    ], [", quoted(table.row.name)?, numbers(&table.times))?;
        writeln!(out, "{}    ], {period}),", numbers(&table.values))?;
    }
    writeln!(
        out,
        "}}\n# outputs to record: name, unit of the FMU, unit to read, and how many of that make one of the FMU's"
    )?;
    writeln!(out, "OUTPUTS = [")?;
    for row in &scene.outputs {
        let (unit, factor) = (row.unit.map_or("1", |unit| unit.name), row.display.map_or(1.0, |shown| shown.factor));
        writeln!(out, "    ({}, {}, {}, {factor:?}),", quoted(row.name)?, quoted(unit)?, quoted(units::name(row))?)?;
    }
    writeln!(out, "]")?;
    Ok(out.replace("[\n]", "[]").replace("{\n}", "{}"))
}

/// A string of Python: those of JSON are.
fn quoted(text: &str) -> Result<String> {
    serde_json::to_string(text).context("a text of the script")
}

/// Entries of a dictionary.
fn values(indent: &str, settings: &[Setting]) -> Result<String> {
    let mut out = String::new();
    for setting in settings {
        writeln!(out, "{indent}{}: {},{}", quoted(setting.row.name)?, number(setting), comment(setting))?;
    }
    Ok(out)
}

/// The tables that act: the last one where two name one input.
fn tables(scene: &Scene) -> impl Iterator<Item = &InputTable> {
    let tables = &scene.input_tables;
    let overridden = |i: usize, name: &str| tables[i + 1..].iter().any(|later| later.row.name == name);
    tables.iter().enumerate().filter(move |(i, table)| !overridden(*i, table.row.name)).map(|(_, table)| table)
}

/// A value in Python, of the type by which the script tells which function sets it; it reads back to the same bits.
fn number(setting: &Setting) -> String {
    match setting.value {
        SettingValue::Real(value) => format!("{value:?}"),
        SettingValue::Integer(value) | SettingValue::Literal(value) => value.to_string(),
        SettingValue::Boolean(true) => "True".into(),
        SettingValue::Boolean(false) => "False".into(),
    }
}

/// What the number does not say: the literal of an enumeration, or the value with its unit.
fn comment(setting: &Setting) -> String {
    match setting.value {
        SettingValue::Real(_) if units::name(setting.row).is_empty() => String::new(),
        SettingValue::Real(_) | SettingValue::Literal(_) => format!("  # {}", setting.text()),
        SettingValue::Integer(_) | SettingValue::Boolean(_) => String::new(),
    }
}

/// Lines of numbers for a list.
fn numbers(values: &[f64]) -> String {
    let mut lines = String::new();
    let mut line = String::new();
    for value in values {
        let cell = format!(" {value:?},");
        if line.len() + cell.len() > WIDTH {
            lines += &format!("       {line}\n");
            line.clear();
        }
        line += &cell;
    }
    lines + &format!("       {line}\n")
}

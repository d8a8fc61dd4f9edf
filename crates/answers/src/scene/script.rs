//! Python script of a scene that runs the FMU with the package `bevel_differential`.

use std::fmt::Write as _;

use anyhow::{Context, Result};

use super::accepted::Accepted;
use super::set::changed_values;
use super::set::{Setting, SettingValue};
use super::{InputTable, Scene, units};

/// Maximum width of a line of numbers.
const WIDTH: usize = 100;

/// Text of the file.
pub fn text(scene: &Scene) -> Result<String> {
    // quotes and backslashes would end or change the docstring
    let plain = |text: &str| text.replace('\\', "/").replace('"', "'");
    Ok(format!(
        "\"\"\"{}: {}\n\n\
         A scene of the bevel gear differential, written by the command `plan`. It needs the Python package bevel_differential\n\
         and records the same numbers, to the last bit, as the library by itself.\n\"\"\"\n\n\
         from bevel_differential import Scene\n\n\
         scene = Scene(\n{})\n\n\
         if __name__ == \"__main__\":\n    \
             record = scene.run()\n    \
             print(scene.summary(record))\n    \
             print(\"record:\", scene.to_csv(record, {}))\n",
        plain(&scene.name),
        plain(&scene.description),
        arguments(scene)?,
        quoted(&format!("{}.csv", scene.name))?
    ))
}

/// Values of the scene, as arguments of `Scene`.
fn arguments(scene: &Scene) -> Result<String> {
    let mut out = String::new();
    writeln!(out, "    {},", quoted(&scene.name)?)?;
    writeln!(out, "    description={},", quoted(&scene.description)?)?;
    writeln!(out, "    stop={:?},  # s", scene.stop_time)?;
    writeln!(out, "    step={:?},  # communication step, s", scene.step)?;
    writeln!(
        out,
        "    # before the start, in SI; what is not named has the FMU's start value\n    set={{\n{}    }},",
        values("        ", &changed_values(scene))?
    )?;
    if !scene.events.is_empty() {
        writeln!(out, "    # later: time in s, then inputs and tunable parameters\n    changes=[")?;
        for event in &scene.events {
            let later = values("            ", &event.settings)?;
            writeln!(out, "        ({:?}, {{\n{later}        }}),", event.time)?;
        }
        writeln!(out, "    ],")?;
    }
    if !scene.input_tables.is_empty() {
        writeln!(
            out,
            "    # straight from point to point: times in s, values in SI, and the period after which they repeat"
        )?;
        writeln!(out, "    tables=[")?;
        for InputTable { row, table } in &scene.input_tables {
            let period = table.period.map_or("None".into(), |period| format!("{period:?}"));
            writeln!(out, "        ({}, [\n{}        ], [", quoted(row.name)?, numbers(&table.times))?;
            writeln!(out, "{}        ], {period}),", numbers(&table.values))?;
        }
        writeln!(out, "    ],")?;
        if !scene.input_slopes {
            writeln!(out, "    input_slopes=False,  # values of tables are held within a step")?;
        }
    }
    if !scene.display_units.is_empty() {
        let names: Result<Vec<String>> = scene.display_units.names().map(quoted).collect();
        writeln!(out, "    display_units=[{}],", names?.join(", "))?;
    }
    match &scene.accepted {
        Accepted::None => {}
        Accepted::All => writeln!(out, "    accept_start_values=True,")?,
        Accepted::Named(names) => {
            let names: Result<Vec<String>> = names.iter().map(|name| quoted(name)).collect();
            writeln!(out, "    accept_start_values=[{}],", names?.join(", "))?;
        }
    }
    let outputs: Result<Vec<String>> = scene.recorded().into_iter().map(quoted).collect();
    writeln!(out, "    outputs=[\n{}    ],", lines("        ", outputs?.into_iter()))?;
    Ok(out)
}

/// Formats a string for Python, whose syntax includes that of JSON.
fn quoted(text: &str) -> Result<String> {
    serde_json::to_string(text).context("a text of the script")
}

/// Entries of a dictionary.
fn values(indent: &str, settings: &[Setting]) -> Result<String> {
    let mut out = String::new();
    for setting in settings {
        writeln!(out, "{indent}{}: {},{}", quoted(setting.row.name)?, value(setting)?, comment(setting))?;
    }
    Ok(out)
}

/// Formats a value for Python: numbers keep all bits, enumerations are literals.
fn value(setting: &Setting) -> Result<String> {
    Ok(match setting.value {
        SettingValue::Real(value) => format!("{value:?}"),
        SettingValue::Integer(value) => value.to_string(),
        SettingValue::Literal(_) => quoted(&setting.text())?,
        SettingValue::Boolean(true) => "True".into(),
        SettingValue::Boolean(false) => "False".into(),
    })
}

/// Comment with the value and its unit.
fn comment(setting: &Setting) -> String {
    match setting.value {
        SettingValue::Real(_) if !units::name(setting.row).is_empty() => format!("  # {}", setting.text()),
        _ => String::new(),
    }
}

/// Lines of numbers for a list.
fn numbers(values: &[f64]) -> String {
    lines("            ", values.iter().map(|value| format!("{value:?}")))
}

/// Lines of the entries of a list.
fn lines(indent: &str, entries: impl Iterator<Item = String>) -> String {
    let mut lines = String::new();
    let mut line = String::new();
    for entry in entries {
        if !line.is_empty() && line.len() + entry.len() > WIDTH {
            lines += &format!("{indent}{}\n", line.trim_end());
            line.clear();
        }
        line += &format!("{entry}, ");
    }
    lines + &format!("{indent}{}\n", line.trim_end())
}

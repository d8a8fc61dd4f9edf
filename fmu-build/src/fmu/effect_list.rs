//! The effects as documents and scripts read them: tables for README.md and docs/effects.md, and a list in JSON beside the
//! FMU. All of it follows from the effects' own declarations.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use bevel_differential::model::{EFFECTS, InputField, effects};
use bevel_differential::variables::{Access, Causality, Variability, Variable, named, table};
use serde_json::{Value, json};

use crate::fmu::documentation::{start, unit};
use crate::tools::paths;
use crate::tools::sections;
use answers::text::table::Table;

type Declared = bevel_differential::model::effects::Declared;

/// The sections of documents that list the effects: document, lines around it, text.
fn sections() -> [(&'static str, [&'static str; 2], String); 2] {
    [
        ("README.md", ["<!-- effects begin -->", "<!-- effects end -->"], overview().markdown()),
        ("docs/effects.md", ["<!-- parameters:begin -->", "<!-- parameters:end -->"], parameters().markdown()),
    ]
}

/// Renews the sections of documents that list the effects.
pub fn write() -> Result<()> {
    sections().iter().try_for_each(|(document, marks, text)| sections::renew(document, *marks, text))
}

/// The document whose list of effects is out of date, if any.
pub fn stale() -> Result<Option<&'static str>> {
    for (document, marks, text) in sections() {
        if !sections::is_current(document, marks, &text)? {
            return Ok(Some(document));
        }
    }
    Ok(None)
}

/// Writes the list of effects in JSON beside the FMU, for scripts.
pub fn write_json(fmu: &Path) -> Result<()> {
    let list: Vec<Value> = EFFECTS.iter().map(described).collect();
    let file = fmu.with_file_name("effects.json");
    fs::write(&file, serde_json::to_string_pretty(&list)?)
        .with_context(|| format!("{} cannot be written", paths::shown(&file)))
}

fn described(effect: &Declared) -> Value {
    json!({
        "name": effect.switch.unwrap_or(effect.name),
        "switch": effect.switch,
        "description": effect.description,
        "inputs": inputs(effect).iter().map(|row| row.name).collect::<Vec<_>>(),
        "parameters": own_parameters(effect).map(|row| row.name).collect::<Vec<_>>(),
        "example": effect.example.iter().map(|&(name, value)| (name.to_owned(), json!(value))).collect::<serde_json::Map<_, _>>(),
        "heat": effect.heat.map(|heat| heat.output),
        "readings": effect.readings.iter().map(|reading| reading.name).collect::<Vec<_>>(),
        "contact": contacts(effect),
    })
}

/// Literals of scene.gear_contact that the effect works with.
fn contacts(effect: &Declared) -> Vec<&'static str> {
    let Some(Access::Enumeration(kind, ..)) = named("scene.gear_contact").map(|row| row.access) else {
        return Vec::new();
    };
    let works = |value| effect.needs.is_none_or(|needs| needs.contacts.iter().any(|&contact| contact as i32 == value));
    kind.choices.iter().filter(|choice| works(choice.value)).map(|choice| choice.name).collect()
}

/// Rows of the effect's own parameters, named `NAME.parameter`.
fn own_parameters(effect: &Declared) -> impl Iterator<Item = &'static Variable> {
    let prefix = format!("{}.", effect.name);
    let is_parameter = |row: &&Variable| row.causality == Causality::Parameter;
    table().rows.iter().filter(is_parameter).filter(move |row| row.name.starts_with(&prefix))
}

/// Rows of the effect's inputs.
fn inputs(effect: &Declared) -> Vec<bevel_differential::declaration::Row<InputField>> {
    effects::inputs_of(effect.name)
}

/// Switch, what it adds, and what it brings to the interface.
fn overview() -> Table {
    let mut table = Table::new(["switch", "what it adds", "own inputs and outputs"]).all_left();
    for effect in EFFECTS {
        let inputs = inputs(effect);
        let heat = effect.heat.map(|heat| heat.output);
        let own = inputs.iter().map(|row| row.name).chain(heat).chain(effect.readings.iter().map(|r| r.name));
        let own: Vec<String> = own.map(|name| format!("`{name}`")).collect();
        let switch = effect.switch.map_or_else(|| "by its input".to_owned(), |switch| format!("`{switch}`"));
        table.push([switch, effect.description.to_owned(), own.join(", ")]);
    }
    table
}

/// Every parameter of every effect.
fn parameters() -> Table {
    let mut table = Table::new(["parameter", "unit [shown]", "start", "tunable", "what it is"]).all_left();
    for row in EFFECTS.iter().flat_map(own_parameters) {
        let tunable = if row.variability == Variability::Tunable { "yes" } else { "" };
        table.push([format!("`{}`", row.name), unit(row), start(row), tunable.to_owned(), row.description.to_owned()]);
    }
    table
}

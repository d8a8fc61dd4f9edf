//! Lists of effects for documents and scripts: tables for README.md and docs/effects.md, and a JSON file next to the
//! FMU. All lists are generated from the declarations of the effects.

use std::path::Path;

use anyhow::Result;
use bevel_differential::model::{EFFECTS, InputField, effects};
use bevel_differential::variables::{Access, Causality, Variable, named, table};
use serde_json::{Value, json};

use crate::fmu::variables_page;
use crate::tools::files::write_whole;
use crate::tools::sections;
use answers::text::table::Table;

type EffectEntry = bevel_differential::model::effects::EffectEntry;

/// Sections of documents that list the effects: document, lines around the section, text.
fn sections() -> [(&'static str, [&'static str; 2], String); 3] {
    [
        ("README.md", ["<!-- effects begin -->", "<!-- effects end -->"], overview().markdown()),
        ("docs/effects.md", ["<!-- interface:begin -->", "<!-- interface:end -->"], interface().markdown()),
        ("docs/variables.md", ["<!-- variables:begin -->", "<!-- variables:end -->"], variables_page::groups()),
    ]
}

/// Renews the sections of documents that list the effects.
pub fn write() -> Result<()> {
    sections().iter().try_for_each(|(document, marks, text)| sections::renew(document, *marks, text))
}

/// Returns a document whose list of effects is out of date, if there is one.
pub fn stale() -> Result<Option<&'static str>> {
    for (document, marks, text) in sections() {
        if !sections::is_current(document, marks, &text)? {
            return Ok(Some(document));
        }
    }
    Ok(None)
}

/// Writes the list of effects as JSON next to the FMU, for scripts.
pub fn write_json(fmu: &Path) -> Result<()> {
    let list: Vec<Value> = EFFECTS.iter().map(described).collect();
    write_whole(&fmu.with_file_name("effects.json"), serde_json::to_string_pretty(&list)?.as_bytes())
}

fn described(effect: &EffectEntry) -> Value {
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

/// Literals of scene.gear_contact that the effect supports.
fn contacts(effect: &EffectEntry) -> Vec<&'static str> {
    let Some(Access::Enumeration(kind, ..)) = named("scene.gear_contact").map(|row| row.access) else {
        return Vec::new();
    };
    let works = |value| effect.needs.is_none_or(|needs| needs.contacts.iter().any(|&contact| contact as i32 == value));
    kind.choices.iter().filter(|choice| works(choice.value)).map(|choice| choice.name).collect()
}

/// Rows of the effect's own parameters, named `NAME.parameter`.
fn own_parameters(effect: &EffectEntry) -> impl Iterator<Item = &'static Variable> {
    let prefix = format!("{}.", effect.name);
    let is_parameter = |row: &&Variable| row.causality == Causality::Parameter;
    table().rows.iter().filter(is_parameter).filter(move |row| row.name.starts_with(&prefix))
}

/// Rows of the effect's inputs.
fn inputs(effect: &EffectEntry) -> Vec<bevel_differential::declaration::Row<InputField>> {
    effects::inputs_of(effect.name)
}

/// Table of names, descriptions, and supported levels of gear contact.
fn overview() -> Table {
    let mut table = Table::new(["`effects.`…", "what it adds", "gear contact"]).all_left();
    for effect in EFFECTS {
        let name = effect.switch.map_or_else(|| "no switch".to_owned(), |_| format!("`{}`", effect.name));
        let contact = if effect.needs.is_some() { contacts(effect).join(", ") } else { "all".to_owned() };
        table.push([name, effect.description.to_owned(), contact]);
    }
    table
}

/// Table of the inputs and outputs that each effect adds.
fn interface() -> Table {
    let mut table = Table::new(["effect", "own inputs and outputs"]).all_left();
    for effect in EFFECTS {
        let own = own_names(effect);
        if !own.is_empty() {
            table.push([format!("`{}`", effect.name), own]);
        }
    }
    table
}

/// Own inputs and outputs of an effect, in short form: only the left of both sides, `planet[i]` for all planets,
/// `GROUP.*` for a group.
fn own_names(effect: &EffectEntry) -> String {
    let inputs = inputs(effect);
    let heat = effect.heat.map(|heat| heat.output);
    let all = inputs.iter().map(|row| row.name).chain(heat).chain(effect.readings.iter().map(|reading| reading.name));
    let of_right = |name: &&str| name.split('.').any(|part| part.starts_with("right"));
    let of_other_planets = |name: &&str| name.starts_with("planet[") && !name.starts_with("planet[1]");
    let mut names: Vec<&str> = all.filter(|name| !of_right(name) && !of_other_planets(name)).collect();
    // names of one group are together, at the position of the first one
    let groups: Vec<&str> = names.iter().map(|name| group(name)).collect();
    names.sort_by_key(|name| groups.iter().position(|&other| other == group(name)));
    let shown = names.chunk_by(|a, b| group(a) == group(b)).map(|same| match same {
        [name] => format!("`{}`", name.replace("[1]", "[i]")),
        [first, ..] => format!("`{}.*`", group(first)),
        [] => String::new(),
    });
    shown.collect::<Vec<_>>().join(", ")
}

/// Part of a variable's name before the first dot.
fn group(name: &str) -> &str {
    name.split_once('.').map_or(name, |(group, _)| group)
}

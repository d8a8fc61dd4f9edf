//! The scene with the chosen setting as a file: that of the scene, with nothing changed but what the setting has otherwise.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::{Variable, table};
use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, Value};

use super::answer::Answer;
use super::input_paths::moved;
use super::words::{percent, setting};
use crate::scene::load;
use crate::scene::set::{Setting, SettingValue};
use crate::text::shown;

/// The scene with the chosen setting, as a file at `to`: paths in it lead to the same files.
pub fn file(answer: &Answer, to: &Path) -> Result<String> {
    let shown = shown(&answer.scene.file);
    let original = fs::read_to_string(&answer.scene.file).with_context(|| format!("{shown} cannot be read"))?;
    moved(text(answer, &original)?, &answer.scene.file, to)
}

/// The file's text, made from that of the scene.
pub fn text(answer: &Answer, original: &str) -> Result<String> {
    let chosen = answer.choice().context("nothing is accurate enough, so that there is no setting to write")?;
    let mut document: DocumentMut = original.parse().context("the scene's file")?;
    let outputs: Array = answer.scene.outputs.iter().map(|row| row.name).collect();
    document["outputs"] = Item::Value(Value::Array(outputs));
    let written = load::parse(&answer.scene.name, &answer.scene.file, original)?;
    let (wanted, inputs) = (chosen.scene.parameters, chosen.scene.inputs);
    for (key, before, after) in
        [("stop_time", written.stop_time, answer.scene.stop_time), ("step", written.step, answer.scene.step)]
    {
        if before != after {
            document[key] = Item::Value(after.into());
        }
    }
    let set = document.entry("set").or_insert_with(|| Item::Table(Table::new()));
    for row in &table().rows {
        let values = [(written.parameters, written.inputs), (wanted, inputs)].map(|(p, i)| value(row, &p, &i));
        if let [Some(before), Some(after)] = values
            && before.to_string() != after.to_string()
        {
            put(set, row.name, after)?;
        }
    }
    let head = format!(
        "# Made from scene {}: {}.\n# Error {} where {} % is wanted, against the richest model.\n\n",
        answer.scene.name,
        setting(&wanted),
        percent(chosen.error()),
        100.0 * answer.within
    );
    let text = format!("{head}{document}");
    let again = load::parse(&answer.scene.name, &answer.scene.file, &text).context("the chosen scene")?;
    ensure!(again.parameters == wanted, "the chosen scene does not come out as it was run");
    Ok(text)
}

/// Value of a parameter or input, as a file has it.
fn value(row: &'static Variable, p: &Parameters, i: &Inputs) -> Option<Value> {
    let setting = Setting::of(row, p, i)?;
    Some(match setting.value {
        SettingValue::Real(number) => number.into(),
        SettingValue::Integer(number) => i64::from(number).into(),
        SettingValue::Boolean(truth) => truth.into(),
        SettingValue::Literal(_) => setting.text().into(),
    })
}

/// Sets a variable where it stands, or anew.
fn put(set: &mut Item, name: &str, value: Value) -> Result<()> {
    let inline = set.is_inline_table();
    let mut table = set.as_table_like_mut().context("set is no table")?;
    let mut key = name;
    if let Some((group, last)) = name.split_once('.')
        && !table.contains_key(name)
    {
        let group = table.entry(group).or_insert_with(|| dotted(inline));
        table = group.as_table_like_mut().with_context(|| format!("{name} stands in no table"))?;
        key = last;
    }
    let item = table.entry(key).or_insert_with(|| Item::Value(value.clone()));
    let old = item.as_value_mut().with_context(|| format!("{name} has no value"))?;
    let decor = old.decor().clone();
    *old = value;
    *old.decor_mut() = decor;
    Ok(())
}

/// A table for keys with dots.
fn dotted(inline: bool) -> Item {
    if inline {
        let mut table = InlineTable::new();
        table.set_dotted(true);
        return Item::Value(Value::InlineTable(table));
    }
    let mut table = Table::new();
    table.set_dotted(true);
    Item::Table(table)
}

//! The scene with the chosen setting as a file: that of the scene, with nothing changed but what the setting has otherwise, and
//! with paths that lead to the same files.

use std::fs;
use std::path::{Path, absolute};

use anyhow::{Context, Result, ensure};
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::{Variable, table};
use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, TableLike, Value};

use super::answer::Answer;
use super::words::{percent, setting};
use crate::scene::set::{Setting, SettingValue};
use crate::scene::{former_names, load};
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
            let former = former_names::of(row.name).filter(|former| stands(set, former));
            put(set, former.as_deref().unwrap_or(row.name), after)?;
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

/// Whether a variable stands there by this name.
fn stands(set: &Item, name: &str) -> bool {
    let has =
        |item: Option<&Item>, key| item.and_then(Item::as_table_like).is_some_and(|table| table.contains_key(key));
    has(Some(set), name) || name.split_once('.').is_some_and(|(group, last)| has(set.get(group), last))
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

/// The text of the scene in `from`, with paths that lead to the same files from where `to` is.
pub fn moved(text: String, from: &Path, to: &Path) -> Result<String> {
    let mut document: DocumentMut = text.parse().context("the scene's file")?;
    let Some(inputs) = document.get_mut("inputs") else { return Ok(text) };
    let folder = |file: &Path| absolute(file).map(|file| file.parent().unwrap_or(&file).to_path_buf());
    let (old, new) = (folder(from)?, folder(to)?);
    let tables: Vec<&mut dyn TableLike> = match inputs {
        Item::ArrayOfTables(tables) => tables.iter_mut().map(|table| table as _).collect(),
        Item::Value(Value::Array(values)) => {
            values.iter_mut().filter_map(Value::as_inline_table_mut).map(|table| table as _).collect()
        }
        _ => Vec::new(),
    };
    for table in tables {
        let Some(file) = table.get("file").and_then(|file| file.as_str()) else { continue };
        let file = old.join(file);
        // there is no way from one drive of Windows to another
        let path = pathdiff::diff_paths(&file, &new).unwrap_or(file);
        table.insert("file", toml_edit::value(path.to_string_lossy().replace('\\', "/")));
    }
    Ok(document.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_scene_finds_the_same_files() -> Result<()> {
        let [from, to] = [Path::new("scenes").join("a.toml"), Path::new("scenes").join("reduced").join("a.toml")];
        for text in ["[[inputs]]\nfile = \"data/cycle.csv\"\n", "inputs = [{ file = \"data/cycle.csv\" }]\n"] {
            let written = moved(text.into(), &from, &to)?;
            assert!(written.contains("\"../data/cycle.csv\""), "{written}");
        }
        assert_eq!(moved("step = 1 # a\n".into(), &from, &to)?, "step = 1 # a\n");
        Ok(())
    }
}

//! Scene file with the chosen setting. It is a copy of the scene's file in which only values of the setting differ.
//! Values that have no influence are removed, and relative paths are adapted to the new folder.

use std::fs;
use std::path::{Path, absolute};

use anyhow::{Context, Result, ensure};
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::effective::Situation;
use bevel_differential::variables::{Variable, named, table};
use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, TableLike, Value};

use super::answer::Answer;
use super::words::{percent, setting};
use crate::scene::acting::{acting, acts};
use crate::scene::curve::{self, CURVE};
use crate::scene::set::{Setting, SettingValue};
use crate::scene::{Scene, load};
use crate::text::shown;

/// Returns the text of the scene file with the chosen setting, to be saved at `to`.
pub fn file(answer: &Answer, to: &Path) -> Result<String> {
    let shown = shown(&answer.scene.file);
    let original = fs::read_to_string(&answer.scene.file).with_context(|| format!("{shown} cannot be read"))?;
    moved(text(answer, &original)?, &answer.scene.file, to)
}

/// Returns the file's text, derived from the `original` file of the scene.
pub fn text(answer: &Answer, original: &str) -> Result<String> {
    let chosen = answer.choice().context("no setting is accurate enough to be written")?;
    let mut document: DocumentMut = original.parse().context("the scene's file")?;
    let outputs: Array = answer.scene.outputs.iter().map(|row| row.name).collect();
    document["outputs"] = Item::Value(Value::Array(outputs));
    take_out_idle(&mut document, &chosen.scene);
    let parsed = |text: &str| load::parse(&answer.scene.name, &answer.scene.file, text);
    let (mut written, wanted) = (parsed(&document.to_string())?, acting(&chosen.scene));
    if differing(&written, &wanted).iter().any(|(row, _)| curve::is_point(row.name)) {
        // a scene with a curve cannot set single points
        if let Some(set) = document.get_mut("set").and_then(Item::as_table_like_mut) {
            take_out(set, "", &|name| name == CURVE);
        }
        written = parsed(&document.to_string())?;
    }
    for (key, before, after) in
        [("stop_time", written.stop_time, answer.scene.stop_time), ("step", written.step, answer.scene.step)]
    {
        if before != after {
            document[key] = Item::Value(after.into());
        }
    }
    let set = document.entry("set").or_insert_with(|| Item::Table(Table::new()));
    for (row, value) in differing(&written, &wanted) {
        put(set, row.name, value)?;
    }
    let head = format!(
        "# Made from scene {}: {}.\n# Error {} relative to the richest model; {} % is allowed.\n\n",
        answer.scene.name,
        setting(&chosen.scene.parameters),
        percent(chosen.error()),
        100.0 * answer.within
    );
    let text = format!("{head}{document}");
    let again = parsed(&text).context("the chosen scene")?;
    ensure!(again.parameters == wanted.parameters, "the written scene differs from the scene that was run");
    Ok(text)
}

/// Variables whose values differ between the scenes `written` and `wanted`, with the values in `wanted`.
fn differing(written: &Scene, wanted: &Scene) -> Vec<(&'static Variable, Value)> {
    let differing = |row| {
        let [before, after] = [written, wanted].map(|scene| value(row, &scene.parameters, &scene.inputs));
        let (before, after) = (before?, after?);
        (before.to_string() != after.to_string()).then_some((row, after))
    };
    table().rows.iter().filter_map(differing).collect()
}

/// Removes values from a scene file that have no influence in `scene`.
fn take_out_idle(document: &mut DocumentMut, scene: &Scene) {
    let is_idle = |name: &str, situation| named(name).is_some_and(|row| !acts(row, scene, situation));
    if let Some(set) = document.get_mut("set").and_then(Item::as_table_like_mut) {
        take_out(set, "", &|name| is_idle(name, Situation::START));
    }
    retain(document.get_mut("at"), &|at| {
        take_out(at, "", &|name| is_idle(name, Situation::RUNNING));
        // its time remains
        at.len() > 1
    });
    let input = |table: &dyn TableLike| table.get("input").and_then(Item::as_str).map(str::to_owned);
    retain(document.get_mut("table"), &|table| !input(table).is_some_and(|name| is_idle(&name, Situation::START)));
}

/// Removes the names that are `idle` from a table with dotted or nested keys.
fn take_out(table: &mut dyn TableLike, prefix: &str, idle: &dyn Fn(&str) -> bool) {
    let keys: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
    for key in keys {
        let name = format!("{prefix}{key}");
        let is_empty = match table.get_mut(&key).and_then(Item::as_table_like_mut) {
            Some(group) => {
                take_out(group, &format!("{name}."), idle);
                group.is_empty()
            }
            None => idle(&name),
        };
        if is_empty {
            table.remove(&key);
        }
    }
}

/// Keeps the tables of a list for which `keep` is true.
fn retain(mut list: Option<&mut Item>, keep: &dyn Fn(&mut dyn TableLike) -> bool) {
    let mut kept = tables(list.as_deref_mut()).into_iter().map(keep).collect::<Vec<_>>().into_iter();
    match list {
        Some(Item::ArrayOfTables(tables)) => tables.retain(|_| kept.next().unwrap_or(true)),
        Some(Item::Value(Value::Array(values))) => {
            values.retain(|value| !value.is_inline_table() || kept.next().unwrap_or(true))
        }
        _ => {}
    }
}

/// Tables of a list.
fn tables(list: Option<&mut Item>) -> Vec<&mut dyn TableLike> {
    match list {
        Some(Item::ArrayOfTables(tables)) => tables.iter_mut().map(|table| table as _).collect(),
        Some(Item::Value(Value::Array(values))) => {
            values.iter_mut().filter_map(Value::as_inline_table_mut).map(|table| table as _).collect()
        }
        _ => Vec::new(),
    }
}

/// Value of a parameter or input, in the form of a scene file.
fn value(row: &'static Variable, p: &Parameters, i: &Inputs) -> Option<Value> {
    let setting = Setting::of(row, p, i)?;
    Some(match setting.value {
        SettingValue::Real(number) => number.into(),
        SettingValue::Integer(number) => i64::from(number).into(),
        SettingValue::Boolean(truth) => truth.into(),
        SettingValue::Literal(_) => setting.text().into(),
    })
}

/// Sets a variable in its existing entry, or adds an entry.
fn put(set: &mut Item, name: &str, value: Value) -> Result<()> {
    let inline = set.is_inline_table();
    let mut table = set.as_table_like_mut().context("set is not a table")?;
    let mut key = name;
    if let Some((group, last)) = name.split_once('.')
        && !table.contains_key(name)
    {
        let group = table.entry(group).or_insert_with(|| dotted(inline));
        table = group.as_table_like_mut().with_context(|| format!("{name} is not in a table"))?;
        key = last;
    }
    let item = table.entry(key).or_insert_with(|| Item::Value(value.clone()));
    let old = item.as_value_mut().with_context(|| format!("{name} has no value"))?;
    replace(old, value);
    Ok(())
}

/// Replaces a value and keeps its blanks and comments.
fn replace(old: &mut Value, value: Value) {
    let decor = old.decor().clone();
    *old = value;
    *old.decor_mut() = decor;
}

/// Existing value of a variable.
fn existing<'a>(set: &'a mut Item, name: &str) -> Option<&'a mut Value> {
    let table = set.as_table_like_mut()?;
    if table.contains_key(name) {
        return table.get_mut(name)?.as_value_mut();
    }
    let (group, last) = name.split_once('.')?;
    table.get_mut(group)?.as_table_like_mut()?.get_mut(last)?.as_value_mut()
}

/// Creates a table for keys with dots.
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

/// Rewrites the scene in `from` for the position `to`, so that its relative paths still lead to the same files.
pub fn moved(text: String, from: &Path, to: &Path) -> Result<String> {
    let mut document: DocumentMut = text.parse().context("the scene's file")?;
    let folder = |file: &Path| absolute(file).map(|file| file.parent().unwrap_or(&file).to_path_buf());
    let (old, new) = (folder(from)?, folder(to)?);
    let moved = |file: &str| {
        let file = old.join(file);
        // Windows has no relative path from one drive to another
        let path = pathdiff::diff_paths(&file, &new).unwrap_or(file);
        path.to_string_lossy().replace('\\', "/")
    };
    for table in tables(document.get_mut("inputs")) {
        let Some(file) = table.get("file").and_then(Item::as_str).map(moved) else { continue };
        table.insert("file", toml_edit::value(file));
    }
    if let Some(curve) = document.get_mut("set").and_then(|set| existing(set, CURVE))
        && let Some(file) = curve.as_str().filter(|text| !curve::is_list(text)).map(moved)
    {
        replace(curve, file.into());
    }
    Ok(document.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_scene_finds_the_same_files() -> Result<()> {
        let [from, to] = [Path::new("scenes").join("a.toml"), Path::new("scenes").join("reduced").join("a.toml")];
        for text in [
            "[[inputs]]\nfile = \"data/cycle.csv\"\n",
            "inputs = [{ file = \"data/cycle.csv\" }]\n",
            "[set]\nlimited_slip.curve = \"data/cycle.csv\"\n",
            "[set.limited_slip]\ncurve = \"data/cycle.csv\"\n",
            "set = { \"limited_slip.curve\" = \"data/cycle.csv\" }\n",
        ] {
            let written = moved(text.into(), &from, &to)?;
            assert!(written.contains("\"../data/cycle.csv\""), "{written}");
        }
        for text in ["step = 1 # a\n", "[set]\nlimited_slip.curve = [[0, 50]] # a\n"] {
            assert_eq!(moved(text.into(), &from, &to)?, text);
        }
        Ok(())
    }
}

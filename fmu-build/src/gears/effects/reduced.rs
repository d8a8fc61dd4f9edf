//! The reduced scene as a file: that of the scene, with nothing changed but the switches and the level of tooth contact.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use toml_edit::{DocumentMut, InlineTable, Item, Table, Value};

use super::sentences::{accuracy, reduction};
use super::switches::{Standing, Switch, level_name, level_variable};
use super::words::{most, percent};
use super::{Finding, Findings};
use crate::gears::scene::{Scene, load};
use crate::tools::paths;

/// Folder of reduced scenes, beside the scene: `scene reduced/NAME` finds them there.
const FOLDER: &str = "reduced";

/// Where the reduced scene of `scene` goes unless told otherwise.
pub fn default_file(scene: &Scene) -> PathBuf {
    scene.file.with_file_name(FOLDER).join(format!("{}.toml", scene.name))
}

/// Refuses a file that is there.
pub fn ensure_new(file: &Path) -> Result<()> {
    if file.exists() {
        bail!("{} is there already: remove it, or name another with --write FILE", paths::shown(file));
    }
    Ok(())
}

/// Writes the reduced scene.
pub fn write(found: &Findings, file: &Path) -> Result<()> {
    ensure_new(file)?;
    let shown = paths::shown(&found.scene.file);
    let original = fs::read_to_string(&found.scene.file).with_context(|| format!("{shown} cannot be read"))?;
    let text = text(found, &original)?;
    let told = || format!("{} cannot be written", paths::shown(file));
    if let Some(folder) = file.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).with_context(told)?;
    }
    fs::write(file, text).with_context(told)
}

/// The file's text, made from that of the scene.
pub fn text(found: &Findings, original: &str) -> Result<String> {
    let mut document: DocumentMut = original.parse().context("the scene's file")?;
    let set = document.entry("set").or_insert_with(|| Item::Table(Table::new()));
    let level = level_name(&found.reduced_scene.parameters);
    if level != level_name(&found.scene.parameters) {
        put(set, level_variable(), level.into(), "")?;
    }
    for row in &found.rows {
        let Switch::Effect(variable) = row.switch else { continue };
        // what was not looked at stays as it is
        if row.verdict.is_kept() || row.verdict.is_left_out() {
            let on = row.switch.is_on(&found.reduced_scene.parameters);
            put(set, variable.name, on.into(), &comment(found, row))?;
        }
    }
    let text = format!("{}{document}", head(found));
    let again = load::parse(&found.scene.name, &found.scene.file, &text).context("the reduced scene")?;
    ensure!(again.parameters == found.reduced_scene.parameters, "the reduced scene does not come out as it was run");
    Ok(text)
}

/// Sets a variable where it stands, or anew.
fn put(set: &mut Item, name: &str, value: Value, comment: &str) -> Result<()> {
    let mut inline = set.is_inline_table();
    let mut table = set.as_table_like_mut().context("set is no table")?;
    let mut key = name;
    if let Some((group, last)) = name.split_once('.')
        && !table.contains_key(name)
    {
        let group = table.entry(group).or_insert_with(|| dotted(inline));
        inline |= group.is_inline_table();
        table = group.as_table_like_mut().with_context(|| format!("{name} stands in no table"))?;
        key = last;
    }
    let item = table.entry(key).or_insert_with(|| Item::Value(value.clone()));
    let old = item.as_value_mut().with_context(|| format!("{name} has no value"))?;
    let decor = old.decor().clone();
    let said = decor.suffix().and_then(|suffix| suffix.as_str()).is_some_and(|text| text.contains('#'));
    *old = value;
    *old.decor_mut() = decor;
    // the author's comment stays, and braces have no room for any
    if !inline && !said && !comment.is_empty() {
        old.decor_mut().set_suffix(format!(" # {comment}"));
    }
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

/// Why an effect is on or off.
fn comment(found: &Findings, row: &Finding) -> String {
    let verdict = row.verdict.text(Standing::On);
    match row.among.change(&found.bench).filter(|change| !change.is_none()) {
        Some(change) => format!("{verdict}: {}, {}", percent(change.largest()), most(found, change)),
        None => verdict,
    }
}

fn head(found: &Findings) -> String {
    let left: Vec<String> = found
        .rows
        .iter()
        .filter(|row| row.verdict.is_left_out())
        .map(|row| match row.among.change(&found.bench) {
            Some(change) => format!("{} {}", row.switch.name(), percent(change.largest())),
            None => row.switch.name().to_owned(),
        })
        .collect();
    let level = [&found.scene, &found.reduced_scene].map(|scene| level_name(&scene.parameters));
    let mut lines = vec![
        format!("Made from scene {}: what it calls for at an accuracy of {}.", found.scene.name, accuracy(found)),
        reduction(found),
        format!(
            "Left out, with what each changes: {}.",
            if left.is_empty() { "nothing".into() } else { left.join(", ") }
        ),
    ];
    if level[0] != level[1] {
        lines.push(format!("Gear contact {} in place of {}.", level[1], level[0]));
    }
    lines.iter().map(|line| format!("# {line}\n")).collect::<String>() + "\n"
}

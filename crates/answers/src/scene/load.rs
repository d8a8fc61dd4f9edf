//! Reads a scene from its TOML file. All errors are reported together, each with key, value, unit and range.
//!
//! ```toml
//! description = "what it shows"
//! stop_time = 0.5                        # in s, or with a unit: "500 ms"
//! step = 1e-3                            # communication step
//! outputs = ["left.speed"]
//! input_slopes = false                   # hold the values of tables within a step; otherwise interpolate linearly
//! display_units = ["rpm", "kN"]          # units for displayed values, instead of the usual ones
//! accept_start_values = true             # no warning about values that nobody set; or a list of their names
//!
//! clutch = { faces = 8, friction = 0.1 }  # packs from all their dimensions, see `clutch`; [set] overrides their values
//!
//! [set]                                  # any parameter or input of the FMU
//! geometry.module = "4.5 mm"             # with a unit, or a number in SI
//! scene.start = "rolling"                # literal of an enumeration
//! limited_slip.curve = "clutch.csv"      # all points of the curve, from a file or a list, see `curve`
//!
//! [[at]]                                 # change of inputs and tunable parameters at a time
//! time = 0.1
//! left.load_torque = 0.0
//!
//! [[table]]                              # an input, interpolated linearly between points
//! input = "carrier.speed_command"
//! time = [0.0, 0.05]
//! value = ["0 deg/s", "100 deg/s"]
//! period = 0.1                           # the table repeats; without a period the last value stays
//!
//! [[inputs]]                             # tables of all inputs in a CSV file
//! file = "cycle.csv"                     # relative to this file
//! columns = { "left.load_torque" = "M_l [Nm]" }    # only these columns; otherwise all
//! wheel_radius = "334 mm"                # converts columns in km/h, m/s or mph to speeds of shafts
//! ```

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::{Access, Variable, table};
use schedule::{MOST, Rule, Schedule};
use serde::Deserialize;
use toml::{Table, Value};

use super::accepted::Accepted;
use super::curve::{self, CURVE};
use super::display_units::DisplayUnits;
use super::input_columns::Wanted;
use super::set::{Setting, SettingValue, output, real, variable};
use super::times::{check_step, duration, seconds, span};
use super::units::six_digits;
use super::value::{self, written};
use super::{Event, InputTable, Scene, clutch, input_file};
use crate::problem::{Problem, Problems, question_error};
use crate::text::{not_text, shown};

/// Problem of a later change of a fixed parameter.
const FIXED: &str = "is fixed: only inputs and tunable parameters change during a run";

/// Keys that every scene has.
const REQUIRED: [&str; 4] = ["description", "stop_time", "step", "outputs"];

/// Other keys with a value.
const OPTIONAL: [&str; 3] = ["input_slopes", "accept_start_values", "display_units"];

/// Contents of a scene file.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    description: Option<String>,
    stop_time: Option<Value>,
    step: Option<Value>,
    input_slopes: Option<Value>,
    accept_start_values: Option<Value>,
    #[serde(default)]
    display_units: Vec<String>,
    clutch: Option<Table>,
    #[serde(default)]
    set: Table,
    #[serde(default)]
    at: Vec<Table>,
    #[serde(default)]
    table: Vec<InputTableEntry>,
    #[serde(default)]
    inputs: Vec<InputFileEntry>,
    outputs: Option<Vec<String>>,
}

impl File {
    /// Names of the required keys that are missing.
    fn missing(&self) -> Vec<&'static str> {
        let given = [self.description.is_some(), self.stop_time.is_some(), self.step.is_some(), self.outputs.is_some()];
        REQUIRED.into_iter().zip(given).filter(|(_, is_given)| !is_given).map(|(key, _)| key).collect()
    }

    fn outputs(&self) -> &[String] {
        self.outputs.as_deref().unwrap_or_default()
    }
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct InputTableEntry {
    input: String,
    time: Vec<Value>,
    value: Vec<Value>,
    period: Option<Value>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct InputFileEntry {
    file: PathBuf,
    period: Option<Value>,
    #[serde(default)]
    columns: Table,
    wheel_radius: Option<Value>,
}

/// Data that the caller of the library adds to a scene file.
#[derive(Clone, Copy, Default)]
pub struct Supplied<'a> {
    /// Contents of input files as CSV, by the path in the scene, for files in other formats, which the caller has read.
    pub contents: Option<&'a BTreeMap<PathBuf, String>>,
    /// Names of quantities that the caller calculates from outputs, and that a scene may name under `outputs`.
    pub quantities: &'a [String],
}

/// Loads the scene in `file`.
pub fn load(file: &Path) -> Result<Scene> {
    load_with(file, &Supplied::default())
}

/// Loads the scene in `file`, with the data of the caller.
pub fn load_with(file: &Path, supplied: &Supplied) -> Result<Scene> {
    let shown = shown(file);
    let text = std::fs::read_to_string(file).map_err(|why| {
        question_error(match why.kind() {
            io::ErrorKind::InvalidData => format!("{shown} {}", not_text(file, "TOML")),
            _ => format!("{shown} cannot be read: {why}"),
        })
    })?;
    let name = file.file_stem().and_then(|stem| stem.to_str()).unwrap_or("scene");
    let entry = toml::from_str(&text).map_err(|why| question_error(unreadable(&why)));
    entry.and_then(|entry| given(name, file, &entry, supplied)).with_context(|| shown)
}

/// Reads the scene `name` from the TOML `text` of `file`.
pub fn parse(name: &str, file: &Path, text: &str) -> Result<Scene> {
    given(name, file, &toml::from_str(text).map_err(|why| question_error(unreadable(&why)))?, &Supplied::default())
}

/// Says why a scene is no TOML, and where the group of a variable belongs if one is in the wrong table.
fn unreadable(why: &toml::de::Error) -> String {
    let group = why.message().strip_prefix("unknown field `").and_then(|rest| rest.split('`').next());
    let is_group = |group: &&str| table().rows.iter().any(|row| row.name.split('.').next() == Some(group));
    match group.filter(is_group) {
        Some(group) => format!("{}variables such as those of {group} belong in the table [set]", why),
        None => why.to_string(),
    }
}

/// Creates the scene `name` from the contents of a scene file. Paths in `entry` are relative to the folder of `file`.
/// Supplied contents of input files replace the files.
pub fn given(name: &str, file: &Path, entry: &File, supplied: &Supplied) -> Result<Scene> {
    let mut problems = Problems::default();
    let missing = entry.missing();
    if !missing.is_empty() {
        let needed = "a scene has description, stop_time, step and outputs";
        problems.push(format!("missing: {}; {needed}", missing.join(", ")));
    }
    let (stop_time, step) = times(entry, &mut problems);
    let set = settings("[set]", &entry.set, Some(folder(file)), &mut problems);
    let settings = with_clutch(entry.clutch.as_ref(), set, &mut problems);
    let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
    settings.iter().for_each(|setting| setting.apply(&mut parameters, &mut inputs));
    let mut events: Vec<Event> = entry.at.iter().filter_map(|at| event(at.clone(), stop_time, &mut problems)).collect();
    events.sort_by(|a, b| a.time.total_cmp(&b.time));
    let mut input_tables: Vec<InputTable> =
        entry.table.iter().filter_map(|table| input_table(table, &mut problems)).collect();
    let mut notes = Vec::new();
    for input_file in &entry.inputs {
        let content = supplied.contents.and_then(|contents| contents.get(&input_file.file)).map(String::as_str);
        let known = input_tables.len();
        notes.extend(add_input_file(input_file, (file, content), &mut input_tables, &mut problems));
        notes.extend(other_end(input_file, &input_tables[known..], stop_time));
    }
    let input_slopes = input_slopes(entry, &mut problems);
    if !input_slopes {
        input_tables.iter_mut().for_each(|driven| driven.table.rule = Rule::Sampled);
    }
    let (outputs, quantities) = outputs(entry.outputs(), supplied.quantities, &mut problems);
    let accepted = entry.accept_start_values.as_ref().map_or(Ok(Accepted::None), Accepted::read);
    let accepted = accepted.map_err(|found| problems.extend(found)).unwrap_or_default();
    let display_units = display_units(&entry.display_units, &mut problems);
    overridden(&events, &input_tables, &mut problems);
    notes.extend(without_influence(&settings, &input_tables));
    let tables = input_tables.iter().map(|driven| &driven.table);
    if let Some(index) = Schedule::new(stop_time, Some(step), Vec::new(), tables).table_with_too_many_stops() {
        let InputTable { row, table } = &input_tables[index];
        let (end, period) = (six_digits(stop_time), table.period.unwrap_or_default());
        problems.push(format!(
            "{} jumps more than {MOST:e} times in {end} s; its period is {period} s: give a longer one",
            row.name
        ));
    }
    problems.or(())?;
    for input_table in &input_tables {
        if let Access::Input(access) = input_table.row.access {
            *access(&mut inputs) = input_table.table.at(0.0);
        }
    }
    Ok(Scene {
        name: name.into(),
        file: file.into(),
        description: entry.description.clone().unwrap_or_default(),
        stop_time,
        step,
        parameters,
        inputs,
        settings,
        events,
        input_tables,
        input_slopes,
        outputs,
        quantities,
        notes,
        display_units,
        accepted,
    })
}

fn display_units(names: &[String], problems: &mut Problems) -> DisplayUnits {
    DisplayUnits::of(names).unwrap_or_else(|found| {
        problems.extend(found.iter().map(|problem| format!("display_units: {problem}")));
        DisplayUnits::default()
    })
}

/// Stop time and communication step [s]; NaN for an invalid or missing one.
fn times(entry: &File, problems: &mut Problems) -> (f64, f64) {
    let mut checked = |length: Result<f64, String>| length.map_err(|problem| problems.push(problem)).ok();
    let stop_time = entry.stop_time.as_ref().and_then(|time| checked(duration("stop_time", time)));
    let step = entry.step.as_ref().and_then(|step| checked(span("step", step)));
    if let (Some(stop_time), Some(step)) = (stop_time, step) {
        problems.extend(check_step(step, stop_time).err());
    }
    (stop_time.unwrap_or(f64::NAN), step.unwrap_or(f64::NAN))
}

/// True if tables are interpolated within steps. This is the default.
fn input_slopes(entry: &File, problems: &mut Problems) -> bool {
    match &entry.input_slopes {
        None => true,
        Some(Value::Boolean(value)) => *value,
        Some(other) => {
            problems.push(format!("input_slopes = {}: it must be true or false", written(other)));
            false
        }
    }
}

/// Folder of a scene's file.
fn folder(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}

/// Settings of a table with dotted or nested keys. Paths are relative to `folder`, which later changes do not have.
/// Messages begin with `place`.
fn settings(place: &str, table: &Table, folder: Option<&Path>, problems: &mut Problems) -> Vec<Setting> {
    let mut found = Vec::new();
    let mut flat = Vec::new();
    flatten("", table, &mut flat);
    let mut names: Vec<&str> = Vec::new();
    for (name, value) in &flat {
        if REQUIRED.iter().chain(&OPTIONAL).any(|key| key == name) {
            problems.push(format!("{place} {name}: it is a key of the scene; write it above [set]"));
            continue;
        }
        if let Some(problem) = curve::set_twice(name, &names) {
            problems.push(format!("{place} {problem}"));
            continue;
        }
        names.push(name);
        let read = match folder {
            None if name == CURVE => Err(Problem::from(format!("{CURVE} {FIXED}")).into()),
            folder => curve::settings(name, value, folder.unwrap_or(Path::new(""))),
        };
        match read {
            Ok(settings) => found.extend(settings),
            Err(of_value) => {
                problems.extend(of_value.0.into_iter().map(|problem| problem.prefixed(&format!("{place} "))))
            }
        }
    }
    found
}

/// Settings of the clutch packs in `table`, followed by the settings `set`, which replace those of the same variables.
fn with_clutch(table: Option<&Table>, set: Vec<Setting>, problems: &mut Problems) -> Vec<Setting> {
    let packs = table.map_or(Ok(Vec::new()), clutch::settings).unwrap_or_else(|found| {
        problems.extend(found.0.into_iter().map(|problem| problem.prefixed("clutch: ")));
        Vec::new()
    });
    let is_replaced = |of_pack: &Setting| set.iter().any(|setting| setting.row.name == of_pack.row.name);
    packs.into_iter().filter(|of_pack| !is_replaced(of_pack)).chain(set.iter().copied()).collect()
}

fn flatten<'a>(prefix: &str, table: &'a Table, out: &mut Vec<(String, &'a Value)>) {
    for (key, value) in table {
        let name = if prefix.is_empty() { key.clone() } else { format!("{prefix}.{key}") };
        match value {
            Value::Table(inner) => flatten(&name, inner, out),
            value => out.push((name, value)),
        }
    }
}

fn event(mut table: Table, stop_time: f64, problems: &mut Problems) -> Option<Event> {
    let time = table.remove("time").ok_or_else(|| "[[at]] has no time".to_owned());
    let time = time
        .and_then(|value| seconds(&value).map_err(|problem| format!("[[at]] time = {}: {problem}", written(&value))));
    let time = time.map_err(|problem| problems.push(problem)).ok()?;
    if !stop_time.is_nan() && !(0.0..=stop_time).contains(&time) {
        let [time, stop_time] = [time, stop_time].map(six_digits);
        problems.push(format!("[[at]] time = {time} s is outside the scene's [0, {stop_time}] s"));
    }
    let place = format!("[[at]] time = {} s:", six_digits(time));
    let settings = settings(&place, &table, None, problems);
    for setting in settings.iter().filter(|setting| !setting.may_come_later()) {
        problems.push(format!("{place} {} {FIXED}", setting.row.name));
    }
    Some(Event { time, settings })
}

/// Reports changes of inputs that also follow a table, because the table would override them.
fn overridden(events: &[Event], input_tables: &[InputTable], problems: &mut Problems) {
    for event in events {
        for name in event.settings.iter().map(|setting| setting.row.name) {
            if input_tables.iter().any(|table| table.row.name == name) {
                let time = six_digits(event.time);
                problems.push(format!(
                    "[[at]] time = {time} s: {name} follows a table, which would override this value; remove the table or the value"
                ));
            }
        }
    }
}

/// Ratio of the end of an input file to the end of the scene above which a remark names both.
const MOST_OVER: f64 = 20.0;

/// Remark about an input file that ends in the first half of the scene, or long after it, as one whose times are in
/// another unit.
fn other_end(entry: &InputFileEntry, tables: &[InputTable], stop_time: f64) -> Option<String> {
    let end = tables
        .iter()
        .filter(|table| table.table.period.is_none())
        .filter_map(|table| table.table.times.last().copied());
    let end = end.reduce(f64::max)?;
    let what = if end < 0.5 * stop_time {
        format!("it ends at {} s, and its last values stay until {} s", six_digits(end), six_digits(stop_time))
    } else if end > MOST_OVER * stop_time {
        format!("it ends at {} s, but the scene already at {} s", six_digits(end), six_digits(stop_time))
    } else {
        return None;
    };
    let file = entry.file.display();
    Some(format!("[[inputs]] file = \"{file}\": {what}; its times are in s unless their header has another unit"))
}

/// Remarks about inputs with a value at the start that a table replaces.
fn without_influence(settings: &[Setting], input_tables: &[InputTable]) -> Vec<String> {
    let replaced = |setting: &Setting| {
        let table = &input_tables.iter().find(|table| table.row.name == setting.row.name)?.table;
        let is_other = !matches!(setting.value, SettingValue::Real(value) if value == table.at(0.0));
        is_other.then(|| {
            format!("[set] {}: a table gives this input from the start, so the value changes nothing", setting.row.name)
        })
    };
    settings.iter().filter_map(replaced).collect()
}

fn input_table(entry: &InputTableEntry, problems: &mut Problems) -> Option<InputTable> {
    let place = format!("[[table]] input = \"{}\":", entry.input);
    let mut report = |what: String| problems.push(format!("{place} {what}"));
    let row = match variable(&entry.input) {
        Ok(row) if !matches!(row.access, Access::Input(_)) => Err("it is not an input".into()),
        found => found,
    };
    let row = row.map_err(&mut report).ok()?;
    let mut numbers = |what: &str, entries: &[Value], read: &dyn Fn(&Value) -> Result<f64, String>| -> Vec<f64> {
        let entry_problem = |entry: &Value, problem: String| format!("{what} {}: {problem}", written(entry));
        entries
            .iter()
            .filter_map(|entry| read(entry).map_err(|problem| report(entry_problem(entry, problem))).ok())
            .collect()
    };
    let values = numbers("value", &entry.value, &|value| real(row, value));
    let times = numbers("time", &entry.time, &seconds);
    if entry.time.len() != entry.value.len() || entry.time.is_empty() {
        report(format!(
            "it has {} times and {} values; give as many of both, at least one",
            entry.time.len(),
            entry.value.len()
        ));
    }
    let rising = times.windows(2).all(|pair| pair[0] <= pair[1]) && times.first().is_none_or(|&t| t >= 0.0);
    if let Some(pair) = times.windows(2).find(|pair| pair[0] > pair[1]) {
        let [before, after] = [pair[0], pair[1]].map(six_digits);
        report(format!("time {after} s comes after {before} s; sort the times, and write a jump as two equal times"));
    } else if !rising || !times.iter().all(|time| time.is_finite()) {
        report("times must be 0 s or more".into());
    }
    let period = entry.period.as_ref().map(|period| span("period", period)).transpose().map_err(report).ok()?;
    let complete = values.len() == times.len() && times.len() == entry.time.len() && !values.is_empty();
    (complete && rising).then_some(InputTable { row, table: schedule::Table::straight(times, values, period) })
}

/// Columns of a file that a scene uses.
fn wanted(entry: &InputFileEntry) -> Result<Wanted, String> {
    let mut flat = Vec::new();
    flatten("", &entry.columns, &mut flat);
    let header = |(name, value): (String, &Value)| match value {
        Value::String(header) => Ok((name, header.clone())),
        other => Err(format!("columns: {name} = {}: must be the header of a column, as text", written(other))),
    };
    let columns = flat.into_iter().map(header).collect::<Result<_, _>>()?;
    let radius = |value: &Value| {
        let read = value::real(value, Some("m"), false).and_then(|radius| {
            if radius > 0.0 && radius.is_finite() { Ok(radius) } else { Err("it must be above 0 m".into()) }
        });
        read.map_err(|problem| format!("wheel_radius = {}: {problem}", written(value)))
    };
    Ok(Wanted { columns, wheel_radius: entry.wheel_radius.as_ref().map(radius).transpose()? })
}

/// Adds the tables of a CSV file, whose path is relative to the folder of the scene file `scene`; `content`: its text,
/// if the caller has read it. Returns messages about unused columns in the file.
fn add_input_file(
    entry: &InputFileEntry,
    (scene, content): (&Path, Option<&str>),
    tables: &mut Vec<InputTable>,
    problems: &mut Problems,
) -> Vec<String> {
    let place = format!("[[inputs]] file = \"{}\":", entry.file.display());
    let period = entry.period.as_ref().map(|period| span("period", period)).transpose();
    let (period, wanted) = match period.and_then(|period| Ok((period, wanted(entry)?))) {
        Ok(read) => read,
        Err(problem) => {
            problems.push(format!("{place} {problem}"));
            return Vec::new();
        }
    };
    let file = folder(scene).join(&entry.file);
    match input_file::read(&file, content, period, &wanted) {
        Ok((read, notes)) => {
            for table in read {
                let name = table.row.name;
                if tables.iter().any(|known| known.row.name == name) {
                    problems.push(format!("{place} {name} has another table in the scene already; remove one of them"));
                }
                tables.push(table);
            }
            notes
        }
        Err(found) => {
            problems.extend(found.iter().map(|problem| format!("[[inputs]] {problem}")));
            Vec::new()
        }
    }
}

/// Outputs among `names`, and the quantities of the caller among them with their places.
fn outputs(
    names: &[String],
    known: &[String],
    problems: &mut Problems,
) -> (Vec<&'static Variable>, Vec<(usize, String)>) {
    let (mut rows, mut quantities) = (Vec::new(), Vec::new());
    for (place, name) in names.iter().enumerate() {
        match output(name) {
            Ok(row) => rows.push(row),
            Err(_) if known.contains(name) => quantities.push((place, name.clone())),
            Err(problem) => problems.push(format!("outputs: {problem}")),
        }
    }
    (rows, quantities)
}

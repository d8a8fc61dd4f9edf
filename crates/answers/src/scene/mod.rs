//! Scenes: what to set, what to feed in and what to record, kept as TOML files; run with the library itself.

pub mod assignments;
pub mod input_file;
pub mod load;
pub mod loads;
pub mod plan;
pub mod run;
pub mod script;
pub mod set;
pub mod ssv;
pub mod times;
pub mod units;
pub mod warnings;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::Variable;

use crate::problem::{Problem, Problems};
use crate::text::shown;
use set::Setting;

/// A scene, ready to start.
#[derive(Clone)]
pub struct Scene {
    /// Name: that of its file without the ending.
    pub name: String,
    /// Its file.
    pub file: PathBuf,
    /// What it shows.
    pub description: String,
    /// Simulated time [s].
    pub stop_time: f64,
    /// Communication step [s].
    pub step: f64,
    /// Parameters.
    pub parameters: Parameters,
    /// Inputs at the start.
    pub inputs: Inputs,
    /// What the file sets at the start.
    pub settings: Vec<Setting>,
    /// What it sets later, by time.
    pub events: Vec<Event>,
    /// Inputs that follow a table.
    pub input_tables: Vec<InputTable>,
    /// Whether tables go on straight within communication steps; otherwise their values are held.
    pub input_slopes: bool,
    /// Outputs to record.
    pub outputs: Vec<&'static Variable>,
}

/// Values set at a time.
#[derive(Clone)]
pub struct Event {
    /// When [s].
    pub time: f64,
    /// What.
    pub settings: Vec<Setting>,
}

/// An input that goes straight from point to point.
#[derive(Clone)]
pub struct InputTable {
    /// The input.
    pub row: &'static Variable,
    /// Times [s], rising; two equal ones are a jump.
    pub times: Vec<f64>,
    /// Values there, in the unit of the interface.
    pub values: Vec<f64>,
    /// Time after which it repeats [s]; none = the last value stays.
    pub period: Option<f64>,
}

impl InputTable {
    /// Times at which the value jumps [s]: those of two points.
    pub fn jumps(&self) -> impl Iterator<Item = f64> + '_ {
        self.times.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0])
    }

    /// Slope over the step from just after `begin` to just before `end` [s], per second. A value that jumps within the step,
    /// or begins its period anew, is held.
    pub fn slope(&self, begin: f64, end: f64) -> f64 {
        let [from, to] = [begin, end].map(|time| self.within_period(time));
        let anew = to < from || self.period.is_some_and(|period| end - begin >= period);
        if anew || self.jumps().any(|jump| from < jump && jump <= to) {
            return 0.0;
        }
        (self.at(end) - self.at(begin)) / (end - begin)
    }

    fn within_period(&self, time: f64) -> f64 {
        self.period.map_or(time, |period| time.rem_euclid(period))
    }

    /// Value at `time` [s], just after a jump.
    pub fn at(&self, time: f64) -> f64 {
        let time = self.within_period(time);
        let after = self.times.partition_point(|&t| t <= time);
        match (after.checked_sub(1), self.times.get(after)) {
            (None, _) => self.values[0],
            (Some(i), None) => self.values[i],
            (Some(i), Some(next)) => {
                let share = (time - self.times[i]) / (next - self.times[i]);
                self.values[i] + share * (self.values[i + 1] - self.values[i])
            }
        }
    }
}

/// The scene in the file `what`, or the one of that name in `folder`.
pub fn find(what: &str, folder: &Path) -> Result<Scene> {
    let file = Path::new(what);
    if file.is_file() {
        return load::load(file);
    }
    let named = folder.join(format!("{what}.toml"));
    if named.is_file() {
        return load::load(&named);
    }
    let files = files(folder)?;
    let names: Vec<&str> = files.iter().filter_map(|file| file.file_stem()?.to_str()).collect();
    let hint = set::closest(what, names.iter().copied());
    let message = match hint {
        Some(name) => format!("no scene is named '{what}'; did you mean '{name}'?"),
        None => format!("no scene is named '{what}', and there is no such file; scenes: {}", names.join(", ")),
    };
    Err(Problems::from(Problem { hint: hint.map(str::to_owned), ..Problem::of("scene", what, message) }).into())
}

/// Files of all scenes in `folder`, by name.
pub fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let unreadable = || format!("{} cannot be read", shown(folder));
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(unreadable)? {
        let path = entry.with_context(unreadable)?.path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// All scenes in `folder`, by name.
pub fn all(folder: &Path) -> Result<Vec<Scene>> {
    files(folder)?.iter().map(|file| load::load(file)).collect()
}

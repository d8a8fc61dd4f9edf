//! Scenes: settings, inputs over time and recorded outputs. They are TOML files and run with the library itself.

pub mod accepted;
pub mod acting;
pub mod assignments;
pub mod clutch;
pub mod curve;
pub mod display_units;
pub mod input_columns;
pub mod input_file;
pub mod load;
pub mod loads;
pub mod off;
pub mod plan;
pub mod run;
pub mod script;
pub mod set;
pub mod ssv;
pub mod time_mean;
pub mod times;
pub mod units;
pub mod value;
pub mod warnings;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::Variable;
use schedule::Table;

use crate::problem::{Problem, Problems};
use crate::text::near::near;
use crate::text::shown;
use accepted::Accepted;
use display_units::DisplayUnits;
use set::Setting;

/// A scene, ready to start.
#[derive(Clone)]
pub struct Scene {
    /// Name: file name without extension.
    pub name: String,
    /// File of the scene.
    pub file: PathBuf,
    /// Description.
    pub description: String,
    /// Simulated time [s].
    pub stop_time: f64,
    /// Communication step [s].
    pub step: f64,
    /// Parameters.
    pub parameters: Parameters,
    /// Inputs at the start.
    pub inputs: Inputs,
    /// Values that the file sets at the start.
    pub settings: Vec<Setting>,
    /// Later changes, by time.
    pub events: Vec<Event>,
    /// Inputs that follow tables.
    pub input_tables: Vec<InputTable>,
    /// True if tables are interpolated within communication steps; otherwise their values are held.
    pub input_slopes: bool,
    /// Outputs to record.
    pub outputs: Vec<&'static Variable>,
    /// Quantities that the caller calculates from outputs, with their places among all names under `outputs`.
    pub quantities: Vec<(usize, String)>,
    /// Messages about unused columns of input files.
    pub notes: Vec<String>,
    /// Units for displayed values, instead of the usual ones.
    pub display_units: DisplayUnits,
    /// Start values of the FMU of which no warning is wanted.
    pub accepted: Accepted,
}

impl Scene {
    /// Names of all outputs and quantities to record, in the order of the file.
    pub fn recorded(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.outputs.iter().map(|row| row.name).collect();
        self.quantities.iter().for_each(|(place, name)| names.insert(*place, name));
        names
    }
}

/// An input that follows a table.
#[derive(Clone)]
pub struct InputTable {
    /// The input.
    pub row: &'static Variable,
    /// Values over time, in the unit of the interface.
    pub table: Table,
}

/// Values set at a time.
#[derive(Clone)]
pub struct Event {
    /// Time [s].
    pub time: f64,
    /// Values.
    pub settings: Vec<Setting>,
}

/// Finds the scene in the file `what`, or the one with that name in `folder`.
pub fn find(what: &str, folder: &Path) -> Result<Scene> {
    load::load(&find_file(what, folder)?)
}

/// Finds the file `what`, or that of the scene with this name in `folder`.
pub fn find_file(what: &str, folder: &Path) -> Result<PathBuf> {
    let (file, named) = (PathBuf::from(what), folder.join(format!("{what}.toml")));
    if let Some(found) = [file, named].into_iter().find(|file| file.is_file()) {
        return Ok(found);
    }
    let files = files(folder)?;
    let names: Vec<&str> = files.iter().filter_map(|file| file.file_stem()?.to_str()).collect();
    let near = near(what, names.iter().copied());
    let message = match near.as_slice() {
        [] => format!("no scene is named '{what}', and there is no such file; scenes: {}", names.join(", ")),
        found => format!("no scene is named '{what}'; did you mean '{}'?", found.join("' or '")),
    };
    let hint = near.first().map(|&name| name.to_owned());
    Err(Problems::from(Problem { hint, ..Problem::of("scene", what, message) }).into())
}

/// Files of all scenes in `folder`, sorted by name.
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

/// All scenes in `folder`, sorted by name.
pub fn all(folder: &Path) -> Result<Vec<Scene>> {
    files(folder)?.iter().map(|file| load::load(file)).collect()
}

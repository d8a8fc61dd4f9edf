//! Scene of a question, given by name, by file, or as values.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::Result;
use serde::Deserialize;

use crate::problem::{Problem, Problems, question_error};
use crate::progress::Progress;
use crate::scene::display_units::DisplayUnits;
use crate::scene::{Scene, assignments, find_file, load};

/// Maximum number of communication points. More would be a mistake, and would not fit into memory.
const MOST_POINTS: f64 = 1e8;

/// A scene and changes to it.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// A file, or the name of a scene in the folder `scenes`. With `given`, it is the name that the scene gets.
    name: String,
    /// The contents of a scene file.
    given: Option<Box<load::File>>,
    /// Changes, each `name=value`.
    #[serde(default)]
    set: Vec<String>,
    /// Units for displayed values; they take precedence over those of the scene.
    #[serde(default)]
    display_units: Vec<String>,
    /// Folder of the named scenes.
    #[serde(default)]
    scenes: PathBuf,
    /// Contents of the scene's input files that are not CSV, as CSV.
    #[serde(default)]
    contents: BTreeMap<PathBuf, String>,
    /// Names of quantities that the caller calculates from outputs.
    #[serde(default)]
    quantities: Vec<String>,
}

impl Source {
    /// Returns the scene. Warns about unused columns of its input files.
    pub fn scene(&self, progress: &mut Progress) -> Result<Scene> {
        let supplied = load::Supplied { contents: Some(&self.contents), quantities: &self.quantities };
        let mut scene = match &self.given {
            Some(file) => load::given(&self.name, Path::new(&self.name), file, &supplied)?,
            None => load::load_with(&find_file(&self.name, &self.scenes)?, &supplied)?,
        };
        assignments::apply(&mut scene, &self.set)?;
        progress.warn(&scene.notes);
        let preferred = DisplayUnits::of(&self.display_units);
        scene.display_units.prefer(preferred.map_err(|found| Problems(found.into_iter().map(Into::into).collect()))?);
        let Scene { stop_time, step, .. } = scene;
        if stop_time / step > MOST_POINTS {
            let reason = format!("more than {MOST_POINTS:e} steps: end earlier, or take longer steps");
            let message = format!("{stop_time} s in steps of {step} s are {reason}");
            return Err(Problems::from(Problem::of("step", step.to_string(), message)).into());
        }
        Ok(scene)
    }
}

/// Parses an optional time with or without a unit [s]. The error names it `name`.
pub fn seconds(name: &str, text: Option<&str>) -> Result<Option<f64>> {
    let read = text.map(crate::scene::units::seconds).transpose();
    read.map_err(|problem| question_error(format!("{name}: {problem}")))
}

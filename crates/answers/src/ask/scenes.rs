//! Questions about scenes: values, plans, runs, exports, tooth loads, and contact patterns.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde::Deserialize;
use serde_json::{Map, Value, json};
use toml::Table;

use super::source::{Source, seconds};
use crate::pattern::cases::{self, PatternCase};
use crate::pattern::{Patterns, findings};
use crate::progress::Progress;
use crate::scene::run::{SceneRun, run};
use crate::scene::set::{Setting, changed_values};
use crate::scene::value::of_text;
use crate::scene::{self, InputTable, Scene, acting, clutch, curve, loads, off, plan, script, ssv};
use crate::text::{shown, whole_file};

/// Request for all scenes of a folder.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScenesQuestion {
    scenes: PathBuf,
}

/// Request about clutch packs.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClutchQuestion {
    /// Dimensions by name, as in a scene file.
    of: Table,
}

/// Request about a measured clutch curve.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CurveQuestion {
    /// Path of a CSV file, relative to the working folder, or a list of points, as on a command line.
    value: String,
}

/// Request about one scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneQuestion {
    of: Source,
}

/// Request to export a scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExportQuestion {
    of: Source,
    format: Format,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Format {
    Ssv,
    Python,
}

/// Request to run a scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunQuestion {
    of: Source,
    /// The CSV file to write.
    out: PathBuf,
}

/// Request for the loads of tooth pairs, or of the final drive.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadsQuestion {
    of: Source,
    /// The file to write.
    out: PathBuf,
    /// True for the forces of the final drive on ring gear and bearings.
    #[serde(default)]
    bearings: bool,
    /// Time between records; by default the scene's communication step.
    #[serde(default)]
    every: Option<String>,
}

/// Request for contact patterns.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatternQuestion {
    /// The scenes; by default the cases of the documentation.
    #[serde(default)]
    of: Vec<Source>,
    /// A coarser answer: longer steps, and fewer of the cases of the documentation.
    #[serde(default)]
    quick: bool,
}

/// Factor by which a quick contact pattern lengthens the steps.
const COARSER: f64 = 4.0;

impl ScenesQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let scenes = scene::all(&self.scenes)?;
        let scene_json =
            |scene: &Scene| json!({"name": scene.name, "description": scene.description, "file": scene.file});
        Ok(json!({"scenes": scenes.iter().map(scene_json).collect::<Vec<_>>()}))
    }
}

impl ClutchQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        Ok(json!({"set": values(&clutch::settings(&self.of)?)}))
    }
}

impl CurveQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let settings = curve::settings(curve::CURVE, &of_text(&self.value), Path::new(""))?;
        Ok(json!({"set": values(&settings)}))
    }
}

impl SceneQuestion {
    pub(super) fn values(&self, progress: &mut Progress) -> Result<Value> {
        let scene = self.of.scene(progress)?;
        let events = scene.events.iter().map(|event| json!({"time": event.time, "set": values(&event.settings)}));
        let tables = scene.input_tables.iter().map(|InputTable { row, table }| {
            json!({"input": row.name, "times": table.times, "values": table.values, "period": table.period})
        });
        Ok(json!({
            "name": scene.name,
            "file": scene.file,
            "description": scene.description,
            "stop_time": scene.stop_time,
            "step": scene.step,
            "set": values(&scene.settings),
            "at": events.collect::<Vec<_>>(),
            "tables": tables.collect::<Vec<_>>(),
            "input_slopes": scene.input_slopes,
            "outputs": scene.recorded(),
            "display_units": scene.display_units.names().collect::<Vec<_>>(),
            "accept_start_values": scene.accepted.json(),
        }))
    }

    pub(super) fn acting(&self, progress: &mut Progress) -> Result<Value> {
        Ok(json!({"names": acting::names(&self.of.scene(progress)?)}))
    }

    pub(super) fn off(&self, progress: &mut Progress) -> Result<Value> {
        let scene = self.of.scene(progress)?;
        let names = scene.outputs.iter().map(|row| row.name).filter(|name| off::reason(name, &scene).is_some());
        Ok(json!({"names": names.collect::<Vec<_>>(), "texts": off::warnings(&scene)}))
    }

    pub(super) fn plan(&self, progress: &mut Progress) -> Result<Value> {
        let scene = self.of.scene(progress)?;
        let run = SceneRun::start(&scene, scene.step)?;
        progress.warn(off::warnings(&scene).into_iter().chain(run.warnings()));
        Ok(json!({"text": plan::text(&scene, &run.simulation)}))
    }
}

impl ExportQuestion {
    pub(super) fn answer(&self, progress: &mut Progress) -> Result<Value> {
        let scene = self.of.scene(progress)?;
        let text = match self.format {
            Format::Ssv => ssv::text(&scene)?,
            Format::Python => script::text(&scene)?,
        };
        Ok(json!({"text": text}))
    }
}

impl LoadsQuestion {
    pub(super) fn answer(&self, progress: &mut Progress) -> Result<Value> {
        let (scene, every) = (self.of.scene(progress)?, seconds("every", self.every.as_deref())?);
        let write = if self.bearings { loads::write_bearings } else { loads::write };
        let (lines, text) = written(&self.out, |file| write(&scene, every, file, progress))?;
        Ok(json!({"lines": lines, "file": self.out, "text": text}))
    }
}

impl RunQuestion {
    pub(super) fn answer(&self, progress: &mut Progress) -> Result<Value> {
        let scene = self.of.scene(progress)?;
        let outcome = written(&self.out, |file| run(&scene, Some(file), progress))?;
        Ok(json!({"text": outcome.text(&scene.display_units), "file": self.out}))
    }
}

/// Calls `write` to create the file `path`, and returns its result.
fn written<T>(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<T>) -> Result<T> {
    let failed = || format!("{} cannot be written", shown(path));
    whole_file::write(path, |part| {
        let mut file = BufWriter::new(File::create(part).with_context(failed)?);
        let done = write(&mut file).map_err(|error| {
            let is_of_file = error.chain().any(|cause| cause.is::<std::io::Error>() || cause.is::<csv::Error>());
            if is_of_file { error.context(failed()) } else { error }
        })?;
        file.flush().with_context(failed)?;
        Ok(done)
    })
}

impl PatternQuestion {
    pub(super) fn answer(&self, progress: &mut Progress) -> Result<Value> {
        let mut cases = match self.of.as_slice() {
            [] => cases::all()?,
            named => named.iter().map(|of| Ok(PatternCase::of(of.scene(progress)?))).collect::<Result<_>>()?,
        };
        let all = cases.len();
        if self.quick && self.of.is_empty() {
            cases.retain(|case| cases::QUICK.contains(&case.name.as_str()));
        }
        let patterns = Patterns::of(&cases, if self.quick { COARSER } else { 1.0 }, progress)?;
        let files: Map<String, Value> =
            patterns.files.iter().map(|(name, text)| ((*name).to_owned(), json!(text))).collect();
        let mut text = patterns.table().terminal();
        if self.quick {
            text += &format!("quick: {} of {all} cases, in steps {COARSER} times as long\n", cases.len());
        }
        Ok(json!({"text": text, "document": findings::markdown(&patterns.findings), "files": files}))
    }
}

/// Values by name.
fn values(settings: &[Setting]) -> Map<String, Value> {
    settings.iter().map(|setting| (setting.row.name.to_owned(), setting.json())).collect()
}

/// Values of `scene` that differ from the FMU's start values, and all values that the scene sets explicitly.
pub(super) fn changed(scene: &Scene) -> Map<String, Value> {
    values(&changed_values(scene))
}

//! Questions about scenes: values, plans, runs, exports, tooth loads, and contact patterns.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde::Deserialize;
use serde_json::{Value, json};

use super::source::{Source, seconds};
use crate::pattern::cases::{self, PatternCase};
use crate::pattern::{Patterns, findings};
use crate::progress::Progress;
use crate::scene::run::{SceneRun, run};
use crate::scene::set::{Setting, changed_values};
use crate::scene::{self, InputTable, Scene, loads, off, plan};
use crate::text::{shown, whole_file};

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
    every: Option<String>,
}

/// Factor by which a quick contact pattern lengthens the steps.
const COARSER: f64 = 4.0;

/// Returns names and descriptions of all scenes in `folder`.
pub fn list(folder: &Path) -> Result<Value> {
    let scenes = scene::all(folder)?;
    let scene_json = |scene: &Scene| json!({"name": scene.name, "description": scene.description, "file": scene.file});
    Ok(json!({"scenes": scenes.iter().map(scene_json).collect::<Vec<_>>()}))
}

/// Contents of a scene.
pub fn contents(scene: &Scene) -> Value {
    let events = scene.events.iter().map(|event| json!({"time": event.time, "set": values(&event.settings)}));
    let tables = scene.input_tables.iter().map(|InputTable { row, table }| {
        json!({"input": row.name, "times": table.times, "values": table.values, "period": table.period})
    });
    json!({
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
    })
}

/// Outputs of a scene that no effect computes, with warnings about them.
pub fn off(scene: &Scene) -> Value {
    let names = scene.outputs.iter().map(|row| row.name).filter(|name| off::reason(name, scene).is_some());
    json!({"names": names.collect::<Vec<_>>(), "texts": off::warnings(scene)})
}

/// Describes what a scene will simulate, and warns as its run would.
pub fn plan(scene: &Scene, progress: &mut Progress) -> Result<String> {
    let run = SceneRun::start(scene, scene.step)?;
    progress.warn(off::warnings(scene).into_iter().chain(run.warnings()));
    Ok(plan::text(scene, &run.simulation))
}

/// Runs a scene and records it in the file `out`.
pub fn record(scene: &Scene, out: &Path, progress: &mut Progress) -> Result<Value> {
    let outcome = written(out, |file| run(scene, Some(file), progress))?;
    Ok(json!({"text": outcome.text(&scene.display_units), "file": out}))
}

impl LoadsQuestion {
    pub(super) fn answer(&self, progress: &mut Progress) -> Result<Value> {
        let (scene, every) = (self.of.scene(progress)?, seconds("every", self.every.as_deref())?);
        let write = if self.bearings { loads::write_bearings } else { loads::write };
        let (lines, text) = written(&self.out, |file| write(&scene, every, file, progress))?;
        Ok(json!({"lines": lines, "file": self.out, "text": text}))
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

/// Contact patterns in scenes, or in the cases of the documentation.
pub fn pattern(of: &[Source], quick: bool, progress: &mut Progress) -> Result<Value> {
    let mut cases = match of {
        [] => cases::all()?,
        named => named.iter().map(|of| Ok(PatternCase::of(of.scene(progress)?))).collect::<Result<_>>()?,
    };
    let all = cases.len();
    if quick && of.is_empty() {
        cases.retain(|case| cases::QUICK.contains(&case.name.as_str()));
    }
    let patterns = Patterns::of(&cases, if quick { COARSER } else { 1.0 }, progress)?;
    let mut text = patterns.table().terminal();
    if quick {
        text += &format!("quick: {} of {all} cases, in steps {COARSER} times as long\n", cases.len());
    }
    let document = findings::markdown(&patterns.findings);
    Ok(json!({"text": text, "document": document, "files": BTreeMap::from(patterns.files)}))
}

/// Values by name.
pub fn values(settings: &[Setting]) -> BTreeMap<&'static str, Value> {
    settings.iter().map(|setting| (setting.row.name, setting.json())).collect()
}

/// Values of `scene` that differ from the FMU's start values, and all values that the scene sets explicitly.
pub fn changed(scene: &Scene) -> BTreeMap<&'static str, Value> {
    values(&changed_values(scene))
}

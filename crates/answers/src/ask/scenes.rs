//! Questions about scenes.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::source::{Source, seconds};
use crate::pattern::cases::{self, PatternCase};
use crate::pattern::{Patterns, findings};
use crate::scene::run::SceneRun;
use crate::scene::set::{Setting, SettingValue};
use crate::scene::start_values::changed_values;
use crate::scene::{self, Scene, loads, plan, script, ssv};
use crate::text::shown;
use crate::watch::Watch;

/// All scenes of a folder.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScenesQuestion {
    scenes: PathBuf,
}

/// A scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneQuestion {
    of: Source,
}

/// A scene as a file for others.
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

/// Loads of tooth pairs.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadsQuestion {
    of: Source,
    /// The file to write.
    out: PathBuf,
    /// Time between records; the scene's communication step where there is none.
    #[serde(default)]
    every: Option<String>,
}

/// Contact patterns.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatternQuestion {
    /// The scenes; without any the cases of the documentation.
    #[serde(default)]
    of: Vec<Source>,
}

impl ScenesQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let scenes = scene::all(&self.scenes)?;
        let told = |scene: &Scene| json!({"name": scene.name, "description": scene.description, "file": scene.file});
        Ok(json!({"scenes": scenes.iter().map(told).collect::<Vec<_>>()}))
    }
}

impl SceneQuestion {
    pub(super) fn values(&self) -> Result<Value> {
        let scene = self.of.scene()?;
        let events = scene.events.iter().map(|event| json!({"time": event.time, "set": values(&event.settings)}));
        let tables = scene.input_tables.iter().map(|table| {
            json!({"input": table.row.name, "times": table.times, "values": table.values, "period": table.period})
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
            "outputs": scene.outputs.iter().map(|row| row.name).collect::<Vec<_>>(),
        }))
    }

    pub(super) fn plan(&self) -> Result<Value> {
        let scene = self.of.scene()?;
        let run = SceneRun::start(&scene, scene.step)?;
        Ok(json!({"text": plan::text(&scene, &run.simulation)}))
    }
}

impl ExportQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let scene = self.of.scene()?;
        let text = match self.format {
            Format::Ssv => ssv::text(&scene)?,
            Format::Python => script::text(&scene)?,
        };
        Ok(json!({"text": text}))
    }
}

impl LoadsQuestion {
    pub(super) fn answer(&self, watch: &mut Watch) -> Result<Value> {
        let (scene, every) = (self.of.scene()?, seconds("every", self.every.as_deref())?);
        let failed = || format!("{} cannot be written", shown(&self.out));
        // nothing is left of a file whose loads came to no end
        let part = self.out.with_added_extension("part");
        let mut file = BufWriter::new(File::create(&part).with_context(failed)?);
        let written = loads::write(&scene, every, &mut file, watch).and_then(|lines| {
            file.flush().with_context(failed)?;
            std::fs::rename(&part, &self.out).with_context(failed)?;
            Ok(lines)
        });
        if written.is_err() {
            let _ = std::fs::remove_file(&part);
        }
        Ok(json!({"lines": written?, "file": self.out}))
    }
}

impl PatternQuestion {
    pub(super) fn answer(&self, watch: &mut Watch) -> Result<Value> {
        let cases = match self.of.as_slice() {
            [] => cases::all()?,
            named => named.iter().map(|of| Ok(PatternCase::of(of.scene()?))).collect::<Result<_>>()?,
        };
        let patterns = Patterns::of(&cases, watch)?;
        let files: Map<String, Value> =
            patterns.files.iter().map(|(name, text)| ((*name).to_owned(), json!(text))).collect();
        let table = patterns.table().terminal();
        Ok(json!({"text": table, "document": findings::markdown(&patterns.findings), "files": files}))
    }
}

/// Values by name: numbers of the interface, literals of enumerations.
fn values(settings: &[Setting]) -> Map<String, Value> {
    let value = |setting: &Setting| match setting.value {
        SettingValue::Real(number) => json!(number),
        SettingValue::Integer(number) => json!(number),
        SettingValue::Boolean(truth) => json!(truth),
        SettingValue::Literal(_) => json!(setting.text()),
    };
    settings.iter().map(|setting| (setting.row.name.to_owned(), value(setting))).collect()
}

/// All that `scene` has otherwise than the FMU, and all that it names.
pub(super) fn changed(scene: &Scene) -> Map<String, Value> {
    values(&changed_values(scene))
}

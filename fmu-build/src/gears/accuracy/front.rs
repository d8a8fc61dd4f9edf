//! All that was tried as CSV, and as a picture of error against cost.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::answer::Answer;
use super::words::setting;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script};

/// Default folder of the results of a scene.
pub fn folder(scene: &str) -> PathBuf {
    paths::target().join("accuracy").join(scene)
}

/// Writes the table of all runs into `folder`: setting, errors, counts, cost, and where each stands in the answer.
pub fn write(answer: &Answer, folder: &Path) -> Result<PathBuf> {
    paths::create_folder(folder)?;
    let file = folder.join("runs.csv");
    let shown = || format!("{} cannot be written", paths::shown(&file));
    let mut rows = csv::Writer::from_path(&file).with_context(shown)?;
    let head = ["tried", "place", "setting", "error", "worst", "evaluations", "steps", "price", "seconds"];
    let wants = answer.wants.iter().map(|want| want.text(&answer.scene));
    rows.write_record(head.into_iter().map(str::to_owned).chain(wants)).with_context(shown)?;
    for (i, trial) in answer.trials.iter().enumerate() {
        let place = match Some(i) {
            run if run == answer.chosen => "chosen",
            run if run == answer.cheaper => "cheaper",
            run if run == answer.richer => "richer",
            _ => "",
        };
        let (worst, error) = trial.worst();
        let effort = &trial.effort;
        let own = [
            trial.what.clone(),
            place.into(),
            setting(&trial.scene.parameters),
            error.to_string(),
            answer.wants[worst].text(&answer.scene),
            effort.evaluations.to_string(),
            effort.steps.to_string(),
            trial.cost.to_string(),
            effort.seconds.to_string(),
        ];
        let errors = trial.errors.iter().map(f64::to_string);
        rows.write_record(own.into_iter().chain(errors)).with_context(shown)?;
    }
    let reference = &answer.reference;
    let own = [
        "the reference".to_owned(),
        "reference".into(),
        setting(&reference.scene.parameters),
        reference.stray().to_string(),
        String::new(),
        reference.effort.evaluations.to_string(),
        reference.effort.steps.to_string(),
        reference.cost.to_string(),
        reference.effort.seconds.to_string(),
    ];
    rows.write_record(own.into_iter().chain(reference.strays.iter().map(f64::to_string))).with_context(shown)?;
    rows.flush().with_context(shown)?;
    Ok(file)
}

/// Draws the front from the table in `folder`.
pub fn draw(answer: &Answer, folder: &Path, progress: &Progress) -> Result<PathBuf> {
    let environment = Environment::ready(|what| progress.stage(what))?;
    let picture = folder.join("front.png");
    // a caption for those who see the picture alone
    let wanted = answer.wants.iter().map(|want| want.text(&answer.scene)).collect::<Vec<_>>().join(", ");
    let about = format!("{}\n{wanted}\n{}\n", answer.scene.name, answer.within);
    fs::write(folder.join("about.txt"), about).context("about.txt cannot be written")?;
    progress.stage("drawing");
    let drawing = paths::workspace().join("fmu-build").join("python").join("front.py");
    script::run(&environment, &drawing, &[folder], progress)?;
    Ok(picture)
}

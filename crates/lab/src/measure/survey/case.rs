//! A question about a random scene, its answer, and the run of the FMU that judges it.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, anyhow};
use bevel_differential::model::Method;

use super::draw;
use answers::accuracy::bench::{Reference, Trial};
use answers::accuracy::record::Record;
use answers::accuracy::reference::at_tolerance;
use answers::accuracy::want::Want;
use answers::accuracy::{Question, answer};
use answers::scene::{Scene, ssv};
use answers::watch::Watch;

/// Accuracies that are asked for.
const WITHIN: [f64; 2] = [0.01, 0.05];
/// The independent reference: a part of the tolerance of the search's own.
const FINER: f64 = 0.1;
/// What is recorded beside the outputs, for orders.
const ANGLES: [&str; 2] = ["planet[1].spin_angle", "carrier.angle"];
/// The part of a run in which the teeth meet, which does not count.
const START: f64 = 0.15;

/// A question with its answer.
pub struct Case {
    /// Scene, quantity and accuracy.
    pub name: String,
    /// The quantity, as it was asked.
    pub want: &'static str,
    /// The accuracy.
    pub within: f64,
    scene: Scene,
    quantity: Want,
    from: f64,
    chosen: Trial,
    /// Whether the answer says that its reference is not certain.
    pub is_uncertain: bool,
    /// How far its reference strays.
    pub stray: f64,
    /// Instructions of the reference over those of the chosen setting.
    pub gain: f64,
    /// Instructions of the search over those of a reference run.
    pub spent: f64,
    /// Values of the quantity: the search's reference, and the independent one.
    values: [f64; 2],
    /// What 100 % is.
    scale: f64,
}

/// What the FMU showed.
pub struct Judged<'a> {
    /// The question.
    pub case: &'a Case,
    /// Error of the chosen setting in the FMU against the independent reference.
    pub error: f64,
    /// Error that the answer gives.
    pub promised: f64,
    /// Difference of both references.
    pub apart: f64,
}

impl Case {
    /// All questions about scene number `index` of `seed`.
    pub fn all_of(seed: u64, index: u64) -> Result<Vec<Self>> {
        let (scene, wants) = draw::scene(seed, index)?;
        let from = START * scene.stop_time;
        let mut cases = Vec::new();
        let mut independent: Option<(Scene, Record)> = None;
        for (i, want) in wants.into_iter().enumerate() {
            for within in WITHIN {
                let question = Question { wants: vec![want.to_owned()], within, from, timed: false };
                let found = answer(&scene, &question, &mut Watch::nobody())?;
                let chosen = found.choice().context("nothing comes to its end")?.clone();
                let reference = &found.reference;
                // one run for all quantities of a scene, by the finest of the references
                let independent = match &independent {
                    Some(known) => known,
                    None => independent.insert(by_radau(&scene, reference, from)?),
                };
                let output =
                    independent.0.outputs.iter().position(|row| row.name == want.split(':').next().unwrap_or_default());
                let output = output.with_context(|| format!("{want} is not recorded"))?;
                let quantity = found.wants[0];
                let value = quantity.statistic.of(&independent.1, output).map_err(|why| anyhow!("{want}: {why}"))?;
                cases.push(Self {
                    name: format!("{index:03}_{i}_{:.0}", 100.0 * within),
                    want,
                    within,
                    from,
                    is_uncertain: found.is_uncertain(),
                    stray: reference.stray(),
                    gain: reference.cost / chosen.cost,
                    spent: found.spent,
                    values: [reference.values[0], value],
                    scale: reference.scales[0],
                    scene: found.scene.clone(),
                    quantity,
                    chosen,
                });
            }
        }
        Ok(cases)
    }

    /// Writes the parameter set of the chosen setting, and what to run.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let outputs: Vec<&str> = self.scene.outputs.iter().map(|row| row.name).chain(ANGLES).collect();
        let run = serde_json::json!({
            "stop": self.chosen.scene.stop_time,
            "step": self.chosen.scene.step,
            "outputs": outputs,
        });
        for (ending, text) in [("ssv", ssv::text(&self.chosen.scene)?), ("json", run.to_string())] {
            let file = folder.join(&self.name).with_extension(ending);
            fs::write(&file, text).with_context(|| format!("{} cannot be written", file.display()))?;
        }
        Ok(())
    }

    /// Compares what the FMU did with the independent reference.
    pub fn judge(&self, folder: &Path) -> Result<Judged<'_>> {
        let record = self.record(folder)?;
        let value = self.quantity.statistic.of(&record, 0).map_err(|why| anyhow!("{}: {why}", self.name))?;
        let [own, independent] = self.values;
        Ok(Judged {
            case: self,
            error: Want::error(value, independent, self.scale),
            promised: self.chosen.error(),
            apart: Want::error(own, independent, self.scale),
        })
    }

    fn record(&self, folder: &Path) -> Result<Record> {
        let file = folder.join(&self.name).with_extension("csv");
        let mut rows = csv::ReaderBuilder::new().has_headers(false).from_path(&file)?;
        let mut record = Record { values: vec![Vec::new()], ..Record::default() };
        let teeth = f64::from(self.scene.parameters.geometry.planet_teeth);
        let from = self.from + 0.5 * self.scene.step;
        for row in rows.records() {
            let numbers = row?.iter().map(str::parse).collect::<Result<Vec<f64>, _>>().context("a number")?;
            let &[time, value, spin, carrier] = numbers.as_slice() else { continue };
            if time > from {
                record.times.push(time);
                record.values[0].push(value);
                record.phases[0].push(teeth * spin);
                record.phases[1].push(carrier);
            }
        }
        Ok(record)
    }
}

/// The richest model by Radau at a tenth of the tolerance, with all outputs of `scene`.
fn by_radau(scene: &Scene, reference: &Reference, from: f64) -> Result<(Scene, Record)> {
    let mut rich = reference.scene.clone();
    rich.outputs.clone_from(&scene.outputs);
    let tolerance = FINER * rich.parameters.solver.relative_tolerance;
    rich.parameters = at_tolerance(&rich.parameters, tolerance);
    rich.parameters.solver.method = Method::Radau;
    let record = Record::of(&rich, from, f64::INFINITY, &mut Watch::nobody()).map_err(|why| anyhow!("radau: {why}"))?;
    Ok((rich, record))
}

//! Effects with verdict: for a scene, what each effect changes among all others, what it costs, and whether the scene
//! needs it at an accuracy; as the command `effects` finds it.

use anyhow::Result;

use super::{CostPlan, measured_here};
use crate::gears::effects::switches::Standing;
use crate::gears::effects::verdict::Verdict;
use crate::gears::effects::words::{name, pair};
use crate::gears::effects::{Finding, Findings, Question, examine};
use crate::gears::scene;
use crate::tools::csv_file::{CsvFile, number, number_or_nan};

/// The columns.
pub const COLUMNS: &str = "scene,accuracy,effect,in_scene,status,message,output,unit,change,limit,cost,cost_spread,\
    evaluations,verdict,kept";

/// The accuracy asked for.
const ACCURACY: f64 = 0.01;
/// The part of a scene that is its start, which does not count.
const START: f64 = 0.02;

/// Measures, and returns the CSV file. `report` receives the fraction done and the current job.
pub fn measure(form: &CostPlan, report: &mut dyn FnMut(f64, &str)) -> Result<String> {
    let mut out = measured_here(
        COLUMNS,
        &[
            "each effect switched in the scene with all effects on that it allows (among all)",
            "change: of the mean, rms, smallest or largest value of an output, whichever changes most, over its scale",
            "cost: time with the effect over that without, evaluations: the same of evaluations of the forces",
            "kept: whether the scene reduced to the accuracy has it; limit: what an output may change by",
        ],
    )?;
    let all = form.scenes.len() as f64;
    for (i, name) in form.scenes.iter().enumerate() {
        let scene = scene::find(name)?;
        let question =
            Question { accuracy: ACCURACY, from: START * scene.stop_time, as_written: false, timed: form.runs > 5 };
        let found =
            examine(&scene, &question, &mut |done, what| report((i as f64 + done) / all, &format!("{name}: {what}")))?;
        for row in &found.rows {
            lines(&found, row, &mut out)?;
        }
    }
    out.text()
}

fn lines(found: &Findings, row: &Finding, out: &mut CsvFile) -> Result<()> {
    let bench = &found.bench;
    let (status, message) = match (&row.verdict, &row.among.run) {
        (Verdict::Fails(why), _) => ("failed", why.as_str()),
        (Verdict::Refused(why), _) | (_, Err(why)) => ("refused", why.as_str()),
        _ => ("ok", ""),
    };
    let pair = pair(row, &row.among);
    let ratio = pair.and_then(|[with, without]| bench.ratio(with, without));
    let evaluations = pair.and_then(|[with, without]| bench.evaluations(with, without));
    let change = row.among.change(bench);
    let standing = if row.standing == Standing::On { "on" } else { "off" };
    for (i, output) in found.scene.outputs.iter().enumerate() {
        let unit = output.unit.map_or("1", |unit| unit.name);
        let accuracy = number(found.accuracy);
        let texts = [&found.scene.name, &accuracy, &name(row), standing, status, message, output.name, unit];
        let numbers = [
            change.map(|change| change.outputs[i].by),
            Some(found.limits[i]),
            ratio.map(|ratio| ratio.median),
            ratio.map(|ratio| ratio.spread),
            evaluations,
        ];
        let verdict = [row.verdict.text(row.standing), row.verdict.is_kept().to_string()];
        out.push(texts.map(str::to_owned).into_iter().chain(numbers.map(number_or_nan)).chain(verdict))?;
    }
    Ok(())
}

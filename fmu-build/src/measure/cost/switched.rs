//! Effects with verdict: for a scene, what each effect changes among all others, what it costs, and whether the scene calls
//! for it at a wanted accuracy; as the command `effects` finds it.

use std::fmt::Write as _;

use anyhow::Result;

use super::measure::number;
use super::{Form, csv};
use crate::gears::effects::switches::Standing;
use crate::gears::effects::verdict::Verdict;
use crate::gears::effects::words::{name, pair};
use crate::gears::effects::{Finding, Findings, Question, examine};
use crate::gears::scene;

/// The columns.
pub const COLUMNS: &str = "scene,accuracy,effect,in_scene,status,message,output,unit,change,limit,cost,cost_spread,\
    evaluations,verdict,kept";

/// The accuracy asked for.
const ACCURACY: f64 = 0.01;
/// The part of a scene that is its start, which does not count.
const START: f64 = 0.02;

/// Does it: the CSV file. `tell` hears how much of the work is done, and what is going on.
pub fn measure(form: &Form, tell: &mut dyn FnMut(f64, &str)) -> Result<String> {
    let mut out = csv::head(
        COLUMNS,
        &[
            "each effect switched in the scene with all effects on that it allows (among all)",
            "change: of the mean, rms, smallest or largest value of an output, whichever changes most, over its scale",
            "cost: time with the effect over that without, evaluations: the same of evaluations of the forces",
            "kept: whether the scene reduced to the accuracy has it; limit: what an output may change by",
        ],
    );
    let all = form.scenes.len() as f64;
    for (i, name) in form.scenes.iter().enumerate() {
        let scene = scene::find(name)?;
        let question =
            Question { accuracy: ACCURACY, from: START * scene.stop_time, as_written: false, timed: form.runs > 5 };
        let found =
            examine(&scene, &question, &mut |done, what| tell((i as f64 + done) / all, &format!("{name}: {what}")))?;
        for row in &found.rows {
            lines(&found, row, &mut out);
        }
    }
    Ok(out)
}

fn lines(found: &Findings, row: &Finding, out: &mut String) {
    let bench = &found.bench;
    let (status, message) = match (&row.verdict, &row.among.run) {
        (Verdict::Fails(why), _) => ("failed", csv::text(why)),
        (Verdict::Refused(why), _) | (_, Err(why)) => ("refused", csv::text(why)),
        _ => ("ok", "-".into()),
    };
    let pair = pair(row, &row.among);
    let ratio = pair.and_then(|[with, without]| bench.ratio(with, without));
    let evaluations = pair.and_then(|[with, without]| bench.evaluations(with, without));
    let told = |value: Option<f64>| number(value.unwrap_or(f64::NAN));
    let change = row.among.change(bench);
    for (i, output) in found.scene.outputs.iter().enumerate() {
        let _ = writeln!(
            out,
            "{},{},{},{},{status},{message},{},{},{},{},{},{},{},{},{}",
            found.scene.name,
            number(found.accuracy),
            csv::text(&name(row)),
            if row.standing == Standing::On { "on" } else { "off" },
            output.name,
            output.unit.map_or("1", |unit| unit.name),
            told(change.map(|change| change.outputs[i].by)),
            number(found.limits[i]),
            told(ratio.map(|ratio| ratio.median)),
            told(ratio.map(|ratio| ratio.spread)),
            told(evaluations),
            csv::text(&row.verdict.text(row.standing)),
            row.verdict.is_kept()
        );
    }
}

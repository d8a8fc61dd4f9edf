//! All changes as CSV: by effect or level, by comparison, by output.

use std::io::Write;

use anyhow::{Context, Result};

use super::change::{Scale, Statistic};
use super::words::{name, pair, scene};
use super::{Finding, Findings, Trial};

/// Writes a line for each effect or level, comparison and output: changes, statistics with and without, costs, verdict.
pub fn write(found: &Findings, out: &mut dyn Write) -> Result<()> {
    write_all(found, out).context("the table cannot be written")
}

fn write_all(found: &Findings, out: &mut dyn Write) -> std::io::Result<()> {
    writeln!(out, "# effects of scene {} at an accuracy of {}", found.scene.name, found.accuracy)?;
    writeln!(
        out,
        "# changes are fractions of the scales; values are SI; with and without are the effect, or the level of"
    )?;
    writeln!(out, "# the scene and the plainer one")?;
    let of = |when: &str| Statistic::ALL.map(|s| format!("{s}_{when}")).join(",");
    writeln!(
        out,
        "switch,scene,comparison,output,unit,rms_scale,magnitude_scale,stray,limit,change,of,by_points,{},{},\
         cost,cost_spread,evaluations_with,evaluations_without,steps_with,steps_without,verdict",
        of("with"),
        of("without")
    )?;
    for row in &found.rows {
        for (comparison, trial) in [("alone", &row.alone), ("among_all", &row.among)] {
            lines(found, row, comparison, trial, out)?;
        }
    }
    Ok(())
}

fn lines(found: &Findings, row: &Finding, comparison: &str, trial: &Trial, out: &mut dyn Write) -> std::io::Result<()> {
    let bench = &found.bench;
    let (Some(change), Some([with, without])) = (trial.change(bench), pair(row, trial)) else { return Ok(()) };
    let ratio = bench.ratio(with, without);
    let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    let standing = scene(row.standing, &row.switch);
    let verdict = row.verdict.text(row.standing).replace('"', "'");
    for (i, output) in found.scene.outputs.iter().enumerate() {
        let Scale { rms, magnitude } = found.scales[i];
        let all = |run: usize| bench.runs[run].statistics[i].map(|value| value.to_string()).join(",");
        let changed = change.outputs[i];
        writeln!(
            out,
            "{},{standing},{comparison},{},{},{rms},{magnitude},{},{},{},{},{},{},{},{},{},{},{},{},{},\"{verdict}\"",
            name(row),
            output.name,
            output.unit.map_or("1", |unit| unit.name),
            found.strays[i],
            found.limits[i],
            changed.by,
            changed.of,
            changed.pointwise,
            all(with),
            all(without),
            number(ratio.map(|r| r.median)),
            number(ratio.map(|r| r.spread)),
            bench.runs[with].evaluations,
            bench.runs[without].evaluations,
            bench.runs[with].steps,
            bench.runs[without].steps,
        )?;
    }
    Ok(())
}

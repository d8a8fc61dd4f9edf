//! Findings as tables and sentences for the terminal, and as CSV.

use std::fmt::Write as _;
use std::io::Write;

use anyhow::{Context, Result};

use super::bench::{Bench, FULL, Ratio, WRITTEN};
use super::change::{Change, Scale, Statistic};
use super::switches::{Standing, Switch, level_name};
use super::verdict::Verdict;
use super::{Finding, Findings, Trial};
use crate::scene::units;

/// Width of the sentences.
const WIDTH: usize = 118;
/// Changes of this many times the scale and more are told as such.
const MANY: f64 = 10.0;
/// What comes before this part of a scene is its start.
const START: f64 = 0.02;
/// Outputs that stray by more than this part of the accuracy are told.
const NOTABLE: f64 = 0.5;

/// A fraction in percent with two significant digits.
pub fn percent(fraction: f64) -> String {
    let percent = fraction * 100.0;
    if percent == 0.0 {
        return "0 %".into();
    }
    if !percent.is_finite() {
        return "no number".into();
    }
    if fraction >= MANY {
        return format!("{fraction:.0} x");
    }
    let decimals = (1.0 - percent.abs().log10().floor()).max(0.0) as usize;
    if decimals > 5 { format!("{percent:.0e} %") } else { format!("{percent:.decimals$} %") }
}

/// All of it.
pub fn text(found: &Findings) -> String {
    let mut out = format!("{}: {}\n\n", found.scene.name, found.scene.description);
    out.push_str(&effects(found));
    for (names, why) in reasons(found) {
        out.push_str(&wrapped(&format!("{}: {why}", names.join(", "))));
    }
    let _ = write!(
        out,
        "\nalone: the other way round in the scene as written; among all: in the fullest scene, with all effects on that\n\
         it allows, or as written; most in: the output and statistic that change most among all; by points: effective value of the\n\
         difference point by point; cost and evaluations of tooth forces: with over without, a level over the plainer.\n\n"
    );
    out.push_str(&outputs(found));
    out.push('\n');
    for sentence in sentences(found) {
        out.push_str(&wrapped(&sentence));
    }
    out
}

/// A row for each effect and level.
fn effects(found: &Findings) -> String {
    let bench = &found.bench;
    let head = ["", "effect", "scene", "alone", "among all", "most in", "by points", "cost", "evaluations", "verdict"];
    let mut rows = vec![head.map(str::to_owned)];
    for (i, row) in found.rows.iter().enumerate() {
        let change = row.among.change(bench);
        let size = |change: Option<&Change>| change.map_or_else(|| "–".into(), |change| percent(change.largest()));
        rows.push([
            (i + 1).to_string(),
            name(row),
            scene(row.standing, &row.switch).into(),
            size(row.alone.change(bench)),
            size(change),
            change.map_or_else(String::new, |change| most(found, change)),
            change.map_or_else(|| "–".into(), |change| percent(change.pointwise())),
            costs(row, bench).map_or_else(|| "–".into(), cost),
            costs_in_evaluations(row, bench).map_or_else(|| "–".into(), |ratio| format!("{ratio:.2}")),
            row.verdict.text(row.standing),
        ]);
    }
    aligned(&rows, &[1, 2, 5, 9])
}

/// Why effects are refused, or scenes without them fail; effects of one reason together.
fn reasons(found: &Findings) -> Vec<(Vec<&'static str>, String)> {
    let mut reasons: Vec<(Vec<&'static str>, String)> = Vec::new();
    for row in &found.rows {
        let (Verdict::Refused(why) | Verdict::Fails(why)) = &row.verdict else { continue };
        // who it is about stands in front anyway
        let why = match row.switch {
            Switch::Effect(variable) => why.strip_prefix(&format!("{}: ", variable.name)).unwrap_or(why),
            Switch::Level(_) => why,
        };
        match reasons.iter_mut().find(|(_, known)| known == why) {
            Some((names, _)) => names.push(row.switch.name()),
            None => reasons.push((vec![row.switch.name()], why.to_owned())),
        }
    }
    reasons
}

/// A row for each output, a column for each effect that changes one.
fn outputs(found: &Findings) -> String {
    let bench = &found.bench;
    let columns: Vec<(usize, &Change)> = found
        .rows
        .iter()
        .enumerate()
        .filter_map(|(i, row)| Some((i + 1, row.among.change(bench)?)))
        .filter(|(_, change)| !change.is_none())
        .collect();
    let mut head: Vec<String> = ["output, among all", "100 %", "strays"].map(str::to_owned).to_vec();
    head.extend(columns.iter().map(|(number, _)| format!("[{number}]")));
    let mut rows = vec![head];
    for (i, output) in found.scene.outputs.iter().enumerate() {
        let scale = units::shown(output, found.scales[i].magnitude);
        let mut row = vec![
            output.name.to_owned(),
            format!("{} {}", three(scale), units::name(output)).trim_end().to_owned(),
            percent(found.strays[i]),
        ];
        row.extend(columns.iter().map(|(_, change)| percent(change.outputs[i].by).replace(" %", "")));
        rows.push(row);
    }
    aligned(&rows, &[0])
}

/// What follows from it, a sentence each.
pub fn sentences(found: &Findings) -> Vec<String> {
    let bench = &found.bench;
    let names = |pick: &dyn Fn(&Finding) -> bool| {
        let rows = found.rows.iter().filter(|row| matches!(row.switch, Switch::Effect(_)) && pick(row));
        rows.map(|row| row.switch.name()).collect::<Vec<_>>()
    };
    let mut out = Vec::new();
    let called = names(&|row| row.verdict.is_kept() && row.verdict != Verdict::Dearer);
    let mut first = format!(
        "At {} this scene calls for gear contact {}{}",
        accuracy(found),
        level_name(&found.reduced_scene.parameters),
        if called.is_empty() { " and no effect".into() } else { format!(" with: {}", called.join(", ")) },
    );
    let dearer = names(&|row| row.verdict == Verdict::Dearer);
    if !dearer.is_empty() {
        let _ = write!(first, "; {} stays on, as off is dearer", dearer.join(", "));
    }
    out.push(format!("{first}."));
    out.push(reduction(found));
    let written = found.written.change(bench).filter(|change| !change.is_none());
    if let Some(change) = written {
        let missing = names(&|row| row.standing == Standing::Off && row.verdict.is_kept());
        let lacks = if missing.is_empty() { String::new() } else { format!(": it lacks {}", missing.join(", ")) };
        out.push(format!(
            "As written it {}differs from it by {}, {}{lacks}.",
            gain(found, WRITTEN),
            percent(change.largest()),
            most(found, change),
        ));
    }
    let spare = names(&|row| row.standing == Standing::On && row.verdict.is_left_out());
    if !spare.is_empty() {
        out.push(format!("On in the scene, and off would do: {}.", spare.join(", ")));
    }
    let early = |row: &&Finding| {
        let worst = row.among.change(bench).and_then(Change::worst);
        let at = worst.and_then(|(_, worst)| worst.at);
        row.verdict == Verdict::Needed && at.is_some_and(|at| at < found.from + START * found.scene.stop_time)
    };
    let early: Vec<&str> = found.rows.iter().filter(early).map(|row| row.switch.name()).collect();
    if !early.is_empty() {
        out.push(format!(
            "{} matter most right after the start: if that is not what the scene is about, --from TIME leaves it out.",
            early.join(", ")
        ));
    }
    let stray: Vec<String> = found
        .scene
        .outputs
        .iter()
        .zip(&found.strays)
        .filter(|(_, stray)| 2.0 * **stray > NOTABLE * found.accuracy)
        .map(|(output, stray)| format!("{} by {}", output.name, percent(*stray)))
        .collect();
    if !stray.is_empty() {
        out.push(format!(
            "When nothing but solver.relative_tolerance is tightened, {} strays; no change below twice that can be told from it.",
            stray.join(", ")
        ));
    }
    let absent = names(&|row| row.standing == Standing::NotThere && row.verdict == Verdict::NotThere);
    if !absent.is_empty() {
        out.push(format!(
            "Part of the question, as they say what is built in, broken or driven, and not looked at unless the scene has \
             them on: {}.",
            absent.join(", ")
        ));
    }
    out
}

/// What the reduced scene is compared with.
fn whole(found: &Findings) -> &'static str {
    if found.as_written { "the scene as written" } else { "everything on" }
}

/// The wanted accuracy, and from when on.
pub fn accuracy(found: &Findings) -> String {
    let from = if found.from > 0.0 { format!(" from {} s on", units::digits(found.from)) } else { String::new() };
    format!("{} %{from}", units::digits(100.0 * found.accuracy))
}

/// What the reduced scene gains and loses.
pub fn reduction(found: &Findings) -> String {
    let Some(change) = found.reduced.change(&found.bench) else { return String::new() };
    let Ok(run) = found.reduced.run else { return String::new() };
    if run == FULL {
        return format!("That is {}.", whole(found));
    }
    let gain = gain(found, run);
    if change.is_none() {
        return format!("That {gain}differs from it in nothing.");
    }
    format!("That {gain}differs from it by at most {}, {}.", percent(change.largest()), most(found, change))
}

/// How much cheaper a run is than everything on.
fn gain(found: &Findings, run: usize) -> String {
    match found.bench.ratio(FULL, run) {
        Some(Ratio { median, spread }) if median >= 1.0 => {
            format!("is {} ± {} times cheaper than {} and ", three(median), three(spread), whole(found))
        }
        Some(Ratio { median, .. }) => format!("takes {} times the time of {} and ", three(1.0 / median), whole(found)),
        None => String::new(),
    }
}

/// The output and statistic of the largest change.
pub fn most(found: &Findings, change: &Change) -> String {
    match change.worst() {
        Some((i, worst)) if worst.by > 0.0 => {
            let at = worst.at.map_or_else(String::new, |at| format!(" at {} s", units::digits(at)));
            format!("{} {}{at}", found.scene.outputs[i].name, worst.of)
        }
        _ => String::new(),
    }
}

/// Name of a row; levels say so.
/// Name of a row.
pub fn name(row: &Finding) -> String {
    match row.switch {
        Switch::Effect(_) => row.switch.name().to_owned(),
        Switch::Level(_) => format!("level {}", row.switch.name()),
    }
}

fn scene(standing: Standing, switch: &Switch) -> &'static str {
    match (switch, standing) {
        (Switch::Level(_), _) => "",
        (_, Standing::On) => "on",
        (_, Standing::Off | Standing::NotThere) => "off",
        (_, Standing::SetOff) => "set off",
    }
}

/// Runs with and without, of the comparison in the fullest scene.
pub fn pair(row: &Finding, trial: &Trial) -> Option<[usize; 2]> {
    let run = trial.run.clone().ok()?;
    let on = match trial.reference {
        FULL => row.in_full,
        _ => row.standing == Standing::On,
    };
    // what is compared with is dearer for a level, and has the effect or lacks it
    let reference_has = on || matches!(row.switch, Switch::Level(_));
    Some(if reference_has { [trial.reference, run] } else { [run, trial.reference] })
}

fn costs(row: &Finding, bench: &Bench) -> Option<Ratio> {
    let [with, without] = pair(row, &row.among)?;
    bench.ratio(with, without)
}

fn costs_in_evaluations(row: &Finding, bench: &Bench) -> Option<f64> {
    let [with, without] = pair(row, &row.among)?;
    bench.evaluations(with, without)
}

fn cost(ratio: Ratio) -> String {
    format!("{} ± {}", three(ratio.median), three(ratio.spread))
}

/// A number with about three digits.
fn three(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let decimals = if value.abs() < 1.0 { 2.0 } else { (2.0 - value.abs().log10().floor()).max(0.0) };
    let text = format!("{value:.*}", decimals as usize);
    if value != 0.0 && text.parse() == Ok(0.0) { format!("{value:.1e}") } else { text }
}

/// Columns in line, those of `left` to the left; a line under the head.
fn aligned<R: AsRef<[String]>>(rows: &[R], left: &[usize]) -> String {
    let columns = rows.first().map_or(0, |row| row.as_ref().len());
    let width = |i: usize| rows.iter().map(|row| row.as_ref()[i].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut out = String::new();
    for (k, row) in rows.iter().enumerate() {
        let cells = row.as_ref().iter().zip(&widths).enumerate();
        let cells =
            cells.map(|(i, (cell, &w))| if left.contains(&i) { format!("{cell:<w$}") } else { format!("{cell:>w$}") });
        let line = cells.collect::<Vec<_>>().join("  ");
        let _ = writeln!(out, "{}", line.trim_end());
        if k == 0 {
            // the verdicts are as long as they are
            let shown = widths.iter().take(columns - 1).sum::<usize>() + 2 * (columns - 1);
            let last = row.as_ref().last().map_or(0, |cell| cell.chars().count());
            let _ = writeln!(
                out,
                "{}",
                "-".repeat(shown + last.max(if left.contains(&(columns - 1)) { 24 } else { widths[columns - 1] }))
            );
        }
    }
    out
}

fn wrapped(text: &str) -> String {
    let (mut out, mut line) = (String::new(), String::new());
    for word in text.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(out, "{line}");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    let _ = writeln!(out, "{line}");
    out
}

/// Writes a line for each effect or level, comparison and output: changes, statistics with and without, costs, verdict.
pub fn csv(found: &Findings, out: &mut dyn Write) -> Result<()> {
    write_csv(found, out).context("the table cannot be written")
}

fn write_csv(found: &Findings, out: &mut dyn Write) -> std::io::Result<()> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percents_have_two_digits_and_ratios_three() {
        assert_eq!([0.0, 0.012_34, 1.5, 3e-9].map(percent), ["0 %", "1.2 %", "150 %", "3e-7 %"]);
        assert_eq!([1.2345, 12.345, 0.012, 0.0, 1e-5].map(three), ["1.23", "12.3", "0.01", "0.00", "1.00e-5"]);
    }
}

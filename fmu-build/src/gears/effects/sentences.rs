//! What follows from the findings, in sentences.

use std::fmt::Write as _;

use super::bench::{FULL, Ratio, WRITTEN};
use super::change::Change;
use super::switches::{Standing, Switch, level_name};
use super::verdict::Verdict;
use super::words::{most, percent, three};
use super::{Finding, Findings};
use crate::gears::scene::units;

/// What comes before this part of a scene is its start.
const START: f64 = 0.02;
/// Outputs that stray by more than this part of the accuracy are told.
const NOTABLE: f64 = 0.5;

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
            "When nothing but the integrator becomes finer, outputs stray: {}; no change of them below twice that can be told.",
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
    if found.as_written { "the scene as written" } else { "with everything on" }
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
        return format!("That is {}.", whole(found).trim_start_matches("with "));
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
        Some(Ratio { median, .. }) => format!(
            "takes {} times the time {} and ",
            three(1.0 / median),
            if found.as_written { "of the scene as written" } else { "that everything on takes" }
        ),
        None => String::new(),
    }
}

//! Findings as tables for the terminal.

use super::bench::{Bench, Ratio};
use super::change::Change;
use super::sentences::sentences;
use super::switches::Switch;
use super::verdict::Verdict;
use super::words::{most, name, pair, percent, scene, three};
use super::{Finding, Findings};
use crate::gears::scene::units;
use crate::tools::table::{Table, wrapped};

/// All of it.
pub fn text(found: &Findings) -> String {
    let mut out = format!("{}: {}\n\n", found.scene.name, found.scene.description);
    out.push_str(&effects(found));
    for (names, why) in reasons(found) {
        out.push_str(&wrapped(&format!("{}: {why}", names.join(", "))));
    }
    out.push('\n');
    out.push_str(&wrapped(&format!(
        "alone: the other way round in the scene as written. Among all: the same in {}. Most in: output and statistic of the \
         largest change among all. By points: effective value of the difference point by point. Cost, evaluations of the \
         tooth forces: with over without, or a level over the plainer one.",
        if found.as_written { "the scene as written too" } else { "the fullest scene, with all on that the scene allows" }
    )));
    out.push('\n');
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
    let mut table = Table::new(head).left([1, 2, 5, 9]);
    for (i, row) in found.rows.iter().enumerate() {
        let change = row.among.change(bench);
        let size = |change: Option<&Change>| change.map_or_else(|| "–".into(), |change| percent(change.largest()));
        table.push([
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
    table.terminal()
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
    let mut table = Table::new(head).left([0]);
    for (i, output) in found.scene.outputs.iter().enumerate() {
        let scale = units::shown(output, found.scales[i].magnitude);
        let mut row = vec![
            output.name.to_owned(),
            format!("{} {}", three(scale), units::name(output)).trim_end().to_owned(),
            percent(found.strays[i]),
        ];
        row.extend(columns.iter().map(|(_, change)| percent(change.outputs[i].by).replace(" %", "")));
        table.push(row);
    }
    table.terminal()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percents_have_two_digits_and_ratios_three() {
        assert_eq!([0.0, 0.012_34, 1.5, 3e-9].map(percent), ["0 %", "1.2 %", "150 %", "3e-7 %"]);
        assert_eq!([1.2345, 12.345, 0.012, 0.0, 1e-5].map(three), ["1.23", "12.3", "0.01", "0.00", "1.00e-5"]);
    }
}

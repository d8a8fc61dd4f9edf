//! The verdict over all cases, and the table of misses.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::case::Judged;
use answers::accuracy::words::{percent, two};
use answers::text::numbers::Spread;
use answers::text::table::{Table, wrapped};
use fmu_build::tools::paths;

/// The reference of an answer is not certain where its own error is above this part of the accuracy.
const THIRD: f64 = 1.0 / 3.0;

fn is_within(found: &Judged) -> bool {
    found.error <= found.case.within
}

/// Whether the reference of the answer was wrong by more than a third of the accuracy, and the answer did not say so.
fn is_silent(found: &Judged) -> bool {
    found.apart > THIRD * found.case.within && !found.case.is_uncertain
}

/// Counts in sentences, and tables of misses and of references that were not certain.
pub fn text(found: &[Judged], failed: &[String]) -> String {
    let certain: Vec<&Judged> = found.iter().filter(|one| !one.case.is_uncertain).collect();
    let within = certain.iter().filter(|one| is_within(one)).count();
    let gains: Vec<f64> = found.iter().map(|one| one.case.gain).collect();
    let spent: Vec<f64> = found.iter().map(|one| one.case.spent).collect();
    let share = 100.0 * within as f64 / certain.len().max(1) as f64;
    let most = spent.iter().copied().fold(0.0, f64::max);
    let mut out = wrapped(&format!(
        "{} questions; in {} the answer says that its reference is not certain. Of the other {}, {within} are within the accuracy, \
         {share:.1} %. In the median the chosen setting is {} times cheaper than the reference, and the search costs {} reference \
         runs, {} at most.",
        found.len(),
        found.len() - certain.len(),
        certain.len(),
        two(Spread::of(&gains).median),
        two(Spread::of(&spent).median),
        two(most),
    ));
    for (title, pick) in [
        (
            "Misses: the chosen setting in the FMU is off by more than wanted",
            (|one| !is_within(one)) as fn(&Judged) -> bool,
        ),
        (
            "Silent: the reference was off by more than a third of the accuracy, and the answer did not say so",
            is_silent,
        ),
        ("Said: the answer says that its reference is not certain", |one| one.case.is_uncertain),
    ] {
        let some: Vec<&Judged> = found.iter().filter(|one| pick(one)).collect();
        out.push_str(&format!("\n{title}: {}\n", some.len()));
        if !some.is_empty() {
            out.push('\n');
            out.push_str(&table(&some).terminal());
        }
    }
    if !failed.is_empty() {
        out.push_str(&format!("\nScenes that cannot be asked: {}\n", failed.len()));
        failed.iter().for_each(|line| out.push_str(&wrapped(line)));
    }
    out
}

fn table(found: &[&Judged]) -> Table {
    let head = ["case", "quantity", "within", "error in the FMU", "error of the answer", "strays", "references apart"];
    let mut table = Table::new(head).left([0, 1]);
    for one in found {
        let numbers = [one.case.within, one.error, one.promised, one.case.stray, one.apart].map(percent);
        table.push([one.case.name.clone(), one.case.want.to_owned()].into_iter().chain(numbers));
    }
    table
}

/// Writes all cases as a table.
pub fn write(found: &[Judged], folder: &Path) -> Result<PathBuf> {
    let file = folder.join("cases.csv");
    let shown = || format!("{} cannot be written", paths::shown(&file));
    let mut rows = csv::Writer::from_path(&file).with_context(shown)?;
    let head = ["case", "want", "within", "error", "promised", "stray", "apart", "uncertain", "gain", "spent"];
    rows.write_record(head).with_context(shown)?;
    for one in found {
        let case = one.case;
        let numbers = [case.within, one.error, one.promised, case.stray, one.apart].map(|x| x.to_string());
        let last = [case.is_uncertain.to_string(), case.gain.to_string(), case.spent.to_string()];
        rows.write_record([case.name.clone(), case.want.to_owned()].into_iter().chain(numbers).chain(last))
            .with_context(shown)?;
    }
    rows.flush().with_context(shown)?;
    Ok(file)
}

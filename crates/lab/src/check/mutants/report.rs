//! The report: counts by room, and the survivors with what a person says about them in docs/mutants.toml.

use std::fmt::Write as _;
use std::fs;

use anyhow::{Context, Result};
use serde::Deserialize;

use super::outcomes::{Fate, Mutant, Run};
use answers::text::table::Table;
use fmu_build::tools::paths;

/// The explanations.
const EXPLANATIONS: &str = "docs/mutants.toml";
/// What stands in the report where nobody has explained a survivor yet.
const OPEN: &str = "**not explained**";

/// Why a change may survive.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explanation {
    file: String,
    change: String,
    code: String,
    why: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Explanations {
    #[serde(default)]
    survivor: Vec<Explanation>,
}

/// All explanations.
pub fn explanations() -> Result<Vec<Explanation>> {
    let text = fs::read_to_string(paths::workspace().join(EXPLANATIONS))
        .with_context(|| format!("{EXPLANATIONS} cannot be read"))?;
    let read: Explanations = toml::from_str(&text).with_context(|| format!("{EXPLANATIONS} is wrong"))?;
    Ok(read.survivor)
}

/// The room of a file: its folder, of the model the folder within.
fn room(file: &str) -> &str {
    let depth = if file.starts_with("src/model/") { 3 } else { 2 };
    file.match_indices('/').nth(depth - 1).map_or(file, |(at, _)| &file[..at])
}

/// The report as Markdown.
pub fn page(run: &Run, explanations: &[Explanation]) -> String {
    let mut rooms: Vec<&str> = run.mutants.iter().map(|mutant| room(&mutant.file)).collect();
    rooms.dedup();
    let mut counts = Table::new(["room", "changes", "noticed", "without end", "no program", "survived"]).left([0]);
    let mut row = |name: String, of: &dyn Fn(&Mutant) -> bool| {
        let count = |fate: Option<Fate>| {
            run.mutants.iter().filter(|m| of(m) && fate.is_none_or(|fate| m.fate == fate)).count().to_string()
        };
        let fates = [Fate::Noticed, Fate::NoEnd, Fate::NoProgram, Fate::Survived];
        counts.push([name, count(None)].into_iter().chain(fates.map(|fate| count(Some(fate)))));
    };
    for name in &rooms {
        row(format!("`{name}`"), &|mutant| room(&mutant.file) == *name);
    }
    row("all".to_owned(), &|_| true);
    let mut out = format!("Shard {}, cargo-mutants {}:\n\n{}", run.shard, run.version, counts.markdown());
    let survivors: Vec<&Mutant> = run.mutants.iter().filter(|mutant| mutant.fate == Fate::Survived).collect();
    if !survivors.is_empty() {
        let mut table = Table::new(["survivor", "explanation"]).all_left();
        for mutant in survivors {
            let same = |e: &&Explanation| e.file == mutant.file && e.change == mutant.change && e.code == mutant.code;
            let why = explanations.iter().find(same);
            // a bar would end the cell
            let name = format!("`{}`: {} at `{}`", mutant.file, mutant.change, mutant.code).replace('|', "\\|");
            table.push([name, why.map_or(OPEN.to_owned(), |e| e.why.trim().to_owned())]);
        }
        let _ = write!(out, "\n{}", table.markdown());
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rooms_are_counted_and_survivors_are_known_by_file_and_change() {
        let mutant = |file: &str, change: &str, fate| Mutant {
            file: file.into(),
            change: change.into(),
            code: "a || b".into(),
            line: 1,
            fate,
        };
        let mutants = vec![
            mutant("src/contact/law.rs", "replace a || b with a", Fate::Survived),
            mutant("src/contact/errors/pitch.rs", "replace + with -", Fate::Noticed),
            mutant("src/model/dynamics/bias.rs", "replace + with -", Fate::Survived),
        ];
        let known = Explanation {
            file: "src/contact/law.rs".into(),
            change: "replace a || b with a".into(),
            code: "a || b".into(),
            why: "b is a shortcut".into(),
        };
        let text = page(&Run { version: "1".into(), shard: "0/1".into(), mutants }, &[known]);
        let has = |room: &str, counts: [&str; 5]| {
            text.lines().any(|line| {
                let cells: Vec<&str> = line.split('|').map(str::trim).collect();
                cells.get(1) == Some(&room) && counts.iter().enumerate().all(|(i, n)| cells.get(i + 2) == Some(n))
            })
        };
        assert!(has("`src/contact`", ["2", "1", "0", "0", "1"]), "{text}");
        assert!(has("`src/model/dynamics`", ["1", "0", "0", "0", "1"]), "{text}");
        assert!(has("all", ["3", "1", "0", "0", "2"]), "{text}");
        assert!(text.contains("replace a \\|\\| b with a") && text.contains("b is a shortcut"));
        assert_eq!(text.matches(OPEN).count(), 1);
    }
}

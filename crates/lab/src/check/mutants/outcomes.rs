//! What became of each change: cargo-mutants' outcomes.json.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use super::tool::SAMPLE;
use fmu_build::tools::paths;

/// What the tests made of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// A test failed.
    Noticed,
    /// All tests passed.
    Survived,
    /// The tests did not come to an end in several times the usual time.
    NoEnd,
    /// It is no program: the compiler refuses it.
    NoProgram,
}

/// A change of the source.
#[derive(Clone, Debug, PartialEq)]
pub struct Mutant {
    /// The file, from the workspace on.
    pub file: String,
    /// What is changed, without the line: it stays when the file grows elsewhere.
    pub change: String,
    /// The source from where it is changed to the end of the line: several places of a function may be changed alike.
    pub code: String,
    /// The line at the time of the run.
    pub line: u64,
    /// What became of it.
    pub fate: Fate,
}

/// A run.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Version of cargo-mutants.
    pub version: String,
    /// The part of all changes that was tried.
    pub shard: String,
    /// Changes in the order of their files.
    pub mutants: Vec<Mutant>,
}

/// The run whose results are in `folder`.
pub fn read(folder: &Path) -> Result<Run> {
    let text = fs::read_to_string(folder.join("outcomes.json")).context("there is no run to report")?;
    let shard = fs::read_to_string(folder.join(SAMPLE)).context("the last run did not come to its end")?;
    let line = |file: &str, number: usize| {
        let source = fs::read_to_string(paths::workspace().join(file)).ok()?;
        Some(source.lines().nth(number.checked_sub(1)?)?.to_owned())
    };
    parsed(&serde_json::from_str(&text).context("outcomes.json is not JSON")?, shard.trim(), line)
}

/// A run from its outcomes; `source` gives a line of a file by its number.
fn parsed(outcomes: &Value, shard: &str, source: impl Fn(&str, usize) -> Option<String>) -> Result<Run> {
    let text = |value: &Value| value.as_str().map(str::to_owned);
    let mut mutants = Vec::new();
    for outcome in outcomes["outcomes"].as_array().context("outcomes.json has no outcomes")? {
        let summary = outcome["summary"].as_str().context("an outcome without a summary")?;
        let mutant = &outcome["scenario"]["Mutant"];
        if mutant.is_null() {
            ensure!(summary == "Success", "the tests fail without any change");
            continue;
        }
        let name = text(&mutant["name"]).context("a change without a name")?;
        let file = text(&mutant["file"]).context("a change without a file")?;
        let start = &mutant["span"]["start"];
        let line = start["line"].as_u64().context("a change without a line")?;
        let before = start["column"].as_u64().context("a change without a column")?.saturating_sub(1) as usize;
        // the source may be another by now
        let code = source(&file, line as usize).unwrap_or_default().chars().skip(before).collect::<String>();
        mutants.push(Mutant {
            file,
            change: without_place(&name).to_owned(),
            code: code.trim_end().to_owned(),
            line,
            fate: match summary {
                "CaughtMutant" => Fate::Noticed,
                "MissedMutant" => Fate::Survived,
                "Timeout" => Fate::NoEnd,
                _ => Fate::NoProgram,
            },
        });
    }
    mutants.sort_by(|a, b| (&a.file, a.line).cmp(&(&b.file, b.line)));
    let version = text(&outcomes["cargo_mutants_version"]).unwrap_or_default();
    Ok(Run { version, shard: shard.to_owned(), mutants })
}

/// The change of a name like "src/a.rs:12:5: replace x with y in f".
fn without_place(name: &str) -> &str {
    name.split_once(": ").map_or(name, |(_, change)| change)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(summary: &str, line: u64) -> Value {
        let name = format!("src/friction/coulomb.rs:{line}:9: replace + with - in coefficient");
        let span = serde_json::json!({"start": {"line": line, "column": 9}, "end": {"line": line, "column": 10}});
        serde_json::json!({"summary": summary, "scenario": {"Mutant": {
            "name": name, "file": "src/friction/coulomb.rs", "span": span}}})
    }

    #[test]
    fn changes_keep_their_names_and_code_when_lines_move_and_failing_tests_are_no_run() {
        let baseline = |summary: &str| serde_json::json!({"summary": summary, "scenario": "Baseline"});
        let of = |base: Value| {
            serde_json::json!({"cargo_mutants_version": "1.2.3", "outcomes":
            [base, outcome("MissedMutant", 30), outcome("CaughtMutant", 12), outcome("Unviable", 40), outcome("Timeout", 50)]})
        };
        let run = parsed(&of(baseline("Success")), "1/9", |_, line| Some(format!("        a + b{line} ")));
        let run = run.expect("a run");
        assert_eq!((run.version.as_str(), run.shard.as_str()), ("1.2.3", "1/9"));
        let found: Vec<_> = run.mutants.iter().map(|m| (m.line, m.fate)).collect();
        assert_eq!(found, [(12, Fate::Noticed), (30, Fate::Survived), (40, Fate::NoProgram), (50, Fate::NoEnd)]);
        assert!(run.mutants.iter().all(|m| m.change == "replace + with - in coefficient"));
        assert_eq!(run.mutants[0].code, "a + b12");
        assert!(parsed(&of(baseline("Failure")), "1/9", |_, _| None).is_err());
    }
}

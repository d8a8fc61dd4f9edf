//! Runs all commands of the laboratory, each in a separate process, and prints one table of the results.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Args;

use answers::problem::question_error;
use answers::text::table::{Table, for_terminal};
use fmu_build::tools::paths;
use fmu_build::tools::program::Finding;
use fmu_build::tools::progress::Progress;

/// Inputs of the commands that a fresh clone lacks, built by `fmu-build`. Tool chains come first.
const MADE: [&str; 3] = ["toolchains", "page", "wheel"];

/// Commands with their options for a complete run. Checks that do not need an idle machine come last.
const COMMANDS: [&[&str]; 24] = [
    &["prices", "--quick"],
    &["cost", "--quick"],
    &["real-time", "--quick"],
    &["zero-cost", "--quick"],
    &["stiffness"],
    &["patterns"],
    &["solids", "--quick"],
    &["survey", "--scenes", "20"],
    &["compare-solvers", "--quick"],
    &["compare-simulators", "--quick"],
    &["drivetrain", "--quick"],
    &["fuzz", "--calls", "100000"],
    &["questions"],
    &["drives", "--count", "300"],
    &["memcheck"],
    &["hosts"],
    &["platforms"],
    &["sources", "--quick"],
    &["test-wheel"],
    &["test-page"],
    &["test-python"],
    &["mutants", "--count", "8"],
    &["coefficients", "--count", "8"],
    &["words"],
];

/// Runs every command of this program in its short form and prints one table of the results (about an hour)
#[derive(Args, Clone, Debug)]
pub struct AllCommand {
    /// Only these commands
    #[arg(value_name = "NAME")]
    only: Vec<String>,
}

impl AllCommand {
    /// Runs the command.
    pub fn run(&self) -> Result<()> {
        if let Some(unknown) = self.only.iter().find(|name| COMMANDS.iter().all(|words| words[0] != name.as_str())) {
            let names = COMMANDS.map(|words| words[0]).join(", ");
            return Err(question_error(format!(
                "{unknown} is not a command that is run here; the commands are {names}"
            )));
        }
        let folder = paths::target().join("all");
        fs::create_dir_all(&folder)?;
        let progress = Progress::start("running all commands");
        let chosen =
            COMMANDS.iter().filter(|words| self.only.is_empty() || self.only.iter().any(|name| name == words[0]));
        let mut table = Table::new(["command", "seconds", "outcome", "last line"]).left([0, 2, 3]);
        let mut failed = Vec::new();
        let own = std::env::current_exe()?;
        let made = MADE
            .iter()
            .filter(|_| self.only.is_empty())
            .map(|&name| ("cargo".into(), vec!["run", "--release", "--", name]));
        for (program, words) in made.chain(chosen.map(|words| (own.clone(), words.to_vec()))) {
            progress.stage(&format!("running {}", words.join(" ")));
            let (row, held) = outcome(&program, &words, &folder)?;
            failed.extend((!held).then(|| words.join(" ")));
            table.push(row);
        }
        progress.finish();
        print!("{}", for_terminal(&table.markdown()));
        println!("\noutput of each command: {}", paths::shown(&folder));
        if failed.is_empty() { Ok(()) } else { Err(Finding(format!("these failed: {}", failed.join(", "))).into()) }
    }
}

/// Runs `program` with `words` and writes its output to a file. Returns its row of the table, and true if it succeeded.
fn outcome(program: &Path, words: &[&str], folder: &Path) -> Result<([String; 4], bool)> {
    let name = words.iter().find(|word| **word != "run" && !word.starts_with('-')).copied().unwrap_or("command");
    let file: PathBuf = folder.join(format!("{name}.txt"));
    let printed = File::create(&file).with_context(|| format!("{} cannot be written", paths::shown(&file)))?;
    let begin = Instant::now();
    let status = Command::new(program)
        .args(words)
        .current_dir(paths::workspace())
        .stdin(Stdio::null())
        .stdout(printed.try_clone()?)
        .stderr(printed)
        .status()
        .with_context(|| format!("{name} cannot be run"))?;
    let seconds = format!("{:.0}", begin.elapsed().as_secs_f64());
    let text = String::from_utf8_lossy(&fs::read(&file)?).into_owned();
    let said = text.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or_default().trim();
    let word = if status.success() { "held" } else { "FAILED" };
    Ok(([words.join(" "), seconds, word.to_owned(), said.chars().take(LONGEST).collect()], status.success()))
}

/// Maximum length of a last line in the table, in characters.
const LONGEST: usize = 90;

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::ffi::OsString;

    use super::*;

    #[test]
    fn every_command_of_the_laboratory_is_run_and_takes_its_options() {
        for words in COMMANDS {
            let arguments = ["lab"].iter().chain(words).map(OsString::from);
            let parsed = crate::command_line::parse(arguments);
            assert!(parsed.is_ok(), "{words:?}");
        }
        let run: BTreeSet<&str> = COMMANDS.iter().map(|words| words[0]).collect();
        assert_eq!(run.len(), COMMANDS.len());
        let missing: Vec<String> = crate::command_line::names()
            .into_iter()
            .filter(|name| name != "all" && !run.contains(name.as_str()))
            .collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}

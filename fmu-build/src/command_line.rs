//! The command line: the commands of all rooms, an overview grouped by their readers, and usage errors in one line.

use std::ffi::OsString;
use std::process::ExitCode;

use anyhow::Result;
use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::check::CheckCommand;
use crate::fmu::BuildCommand;
use crate::gears::GearsCommand;
use crate::gears::study::StudyCommand;
use crate::measure::MeasureCommand;

/// How users call this program.
const PROGRAM: &str = "cargo run --release --";
/// Exit code of usage errors.
pub const USAGE: u8 = 2;

#[derive(Parser)]
#[command(name = "fmu-build", bin_name = PROGRAM, version, disable_help_subcommand = true)]
#[command(args_conflicts_with_subcommands = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Option<AnyCommand>,
    #[command(flatten)]
    study: StudyCommand,
}

/// A command of any room.
#[derive(Subcommand)]
#[allow(missing_docs)] // each command describes itself
pub enum AnyCommand {
    #[command(flatten)]
    Gears(GearsCommand),
    #[command(flatten)]
    Build(BuildCommand),
    #[command(flatten)]
    Measure(MeasureCommand),
    #[command(flatten)]
    Check(CheckCommand),
    /// Shows this overview, or the options of a command
    #[command(hide = true)]
    Help {
        /// A command
        command: Option<String>,
    },
}

impl AnyCommand {
    /// Runs the command.
    pub fn run(self) -> Result<()> {
        match self {
            Self::Gears(command) => command.run(),
            Self::Build(command) => command.run(),
            Self::Measure(command) => command.run(),
            Self::Check(command) => command.run(),
            // answered while the command line is read
            Self::Help { .. } => Ok(()),
        }
    }
}

/// Why no command runs: help was asked for, or the command line is wrong.
#[derive(Debug)]
pub struct Stop(clap::Error);

impl Stop {
    /// Prints help to standard output, or a usage error as one line to standard error.
    pub fn report(&self) -> ExitCode {
        if self.0.use_stderr() {
            eprintln!("{}", self.one_line());
            return ExitCode::from(USAGE);
        }
        // a closed pipe is no reason to fail
        let _ = self.0.print();
        ExitCode::SUCCESS
    }

    /// The usage error with clap's suggestion, and where to read on.
    fn one_line(&self) -> String {
        let text = self.0.render().to_string();
        let lines = text.lines().map(str::trim).take_while(|line| !line.starts_with("Usage:"));
        let parts: Vec<&str> = lines.filter(|line| !line.is_empty() && !line.starts_with("For more")).collect();
        let line = parts.join(" ").replace(" tip: ", "; ").replace(" [possible values", "; [possible values");
        let usage = text.lines().find_map(|line| line.trim().strip_prefix("Usage: "));
        let named = usage.and_then(|usage| usage.strip_prefix(PROGRAM)?.split_whitespace().next());
        let command = named.filter(|word| word.starts_with(|c: char| c.is_ascii_lowercase()));
        format!("{line} (see {PROGRAM} {}--help)", command.map_or(String::new(), |name| format!("{name} ")))
    }
}

/// The command that `arguments`, the program's name first, ask for: the study if they name none.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<AnyCommand, Stop> {
    let matches = command().try_get_matches_from(arguments).map_err(Stop)?;
    let CommandLine { command: named, study } = CommandLine::from_arg_matches(&matches).map_err(Stop)?;
    match named {
        None => Ok(AnyCommand::Gears(GearsCommand::Study(study))),
        Some(AnyCommand::Help { command: None }) => Err(help(&[])),
        Some(AnyCommand::Help { command: Some(name) }) => Err(help(&[name])),
        Some(command) => Ok(command),
    }
}

/// What `--help` after `command` shows.
fn help(command_name: &[String]) -> Stop {
    let words = ["fmu-build".to_owned()].into_iter().chain(command_name.iter().cloned());
    let shown = command().try_get_matches_from(words.chain(["--help".to_owned()]));
    Stop(shown.err().unwrap_or_else(|| clap::Error::new(ErrorKind::DisplayHelp)))
}

fn command() -> clap::Command {
    // the last of two equal options counts, as in most programs
    CommandLine::command()
        .args_override_self(true)
        .override_help(overview())
        .mut_subcommands(|command| command.args_override_self(true))
}

/// The commands by room, a line each.
fn overview() -> String {
    let blank = || clap::Command::new("room");
    let rooms = [
        ("For users of the gears:", GearsCommand::augment_subcommands(blank())),
        ("Building the FMU:", BuildCommand::augment_subcommands(blank())),
        ("Measuring:", MeasureCommand::augment_subcommands(blank())),
        ("Checking:", CheckCommand::augment_subcommands(blank())),
    ];
    let all = || rooms.iter().flat_map(|(_, room)| room.get_subcommands());
    let width = all().map(|command| command.get_name().len()).max().unwrap_or(0);
    let mut out = format!("Usage: {PROGRAM} [COMMAND] [OPTIONS]\n");
    for (title, room) in &rooms {
        out.push_str(&format!("\n{title}\n"));
        for command in room.get_subcommands() {
            let about = command.get_about().map_or(String::new(), ToString::to_string);
            out.push_str(&format!("  {:<width$}  {about}\n", command.get_name()));
        }
    }
    out.push_str(&format!("\nWithout a command: study. Options of a command: {PROGRAM} COMMAND --help\n"));
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(words: &[&str]) -> Result<AnyCommand, Stop> {
        parse(["fmu-build"].iter().chain(words).map(OsString::from))
    }

    #[test]
    fn the_declared_options_are_consistent() {
        command().debug_assert();
    }

    #[test]
    fn without_a_command_the_study_runs() {
        for (words, readme) in [(&[][..], false), (&["--readme"], true), (&["study", "--readme"], true)] {
            let found = parsed(words);
            assert!(
                matches!(&found, Ok(AnyCommand::Gears(GearsCommand::Study(study))) if study.readme == readme),
                "{words:?}"
            );
        }
    }

    #[test]
    fn former_names_still_work_and_are_not_shown() {
        for old in ["off", "peers", "foreign", "memory"] {
            assert!(parsed(&[old]).is_ok(), "{old}");
            assert!(!overview().contains(&format!("  {old} ")), "{old}");
        }
    }

    #[test]
    fn a_usage_error_is_one_line_with_a_suggestion() {
        for (words, parts) in [
            (&["geometri"][..], &["'geometri'", "'geometry'"][..]),
            (&["geometry", "--facet", "4"], &["'--facet'", "'--facets'", "geometry --help"]),
            (&["loads", "--out", "x"], &["--scene"]),
            (&["--quik"], &["'--quik'"]),
        ] {
            let line = parsed(words).err().map(|stop| stop.one_line()).unwrap_or_default();
            assert!(!line.contains('\n') && parts.iter().all(|part| line.contains(part)), "{words:?}: {line}");
        }
    }

    #[test]
    fn a_repeated_option_counts_last() {
        assert!(parsed(&["cost", "--quick", "--quick", "--out", "a", "--out", "b"]).is_ok());
    }
}

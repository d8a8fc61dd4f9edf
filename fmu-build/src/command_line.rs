//! Command line with the commands of all modules, grouped by users.

use std::ffi::OsString;

use anyhow::Result;
use clap::{Args as _, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use crate::environment::EnvironmentCommand;
use crate::fmu::BuildCommand;
use crate::study::StudyCommand;
use crate::tools::program::{Program, Stop};

/// Command line of this program.
pub const PROGRAM: &str = "cargo run --release --";
/// Command line of the laboratory, a separate program.
pub const LABORATORY: &str = "python3 crates/lab/lab.py";

#[derive(Parser)]
#[command(name = "fmu-build", version, disable_help_subcommand = true)]
#[command(args_conflicts_with_subcommands = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Option<AnyCommand>,
    #[command(flatten)]
    study: StudyCommand,
}

/// A command of any group.
#[derive(Subcommand)]
#[allow(missing_docs)] // each command describes itself
pub enum AnyCommand {
    Study(StudyCommand),
    #[command(flatten)]
    Build(BuildCommand),
    #[command(hide = true)]
    Environment(EnvironmentCommand),
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
            Self::Study(command) => command.run(),
            Self::Build(command) => command.run(),
            Self::Environment(command) => command.run(),
            // already handled while parsing
            Self::Help { .. } => Ok(()),
        }
    }
}

/// Parses `arguments`, which start with the program's name. Without a command, the study runs.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<AnyCommand, Stop> {
    let program = program();
    let matches = program.parse(arguments)?;
    let CommandLine { command, study } =
        CommandLine::from_arg_matches(&matches).map_err(|error| program.stop(&error))?;
    match command {
        None => Ok(AnyCommand::Study(study)),
        Some(AnyCommand::Help { command }) => Err(program.help(command)),
        Some(command) => Ok(command),
    }
}

fn program() -> Program {
    let blank = || clap::Command::new("group");
    Program {
        call: PROGRAM,
        root: CommandLine::command(),
        groups: vec![
            ("For users of the gears:", blank().subcommand(StudyCommand::augment_args(clap::Command::new("study")))),
            ("Building the FMU:", BuildCommand::augment_subcommands(blank())),
        ],
        end: format!(
            "Without a command: study. Options of a command: {PROGRAM} COMMAND --help\n\
             Commands that measure and check are in the laboratory: {LABORATORY} help\n\
             Commands that answer questions about gears and scenes are in the Python package: \
             target/python/bin/bevel-differential --help"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(words: &[&str]) -> Result<AnyCommand, Stop> {
        parse(["fmu-build"].iter().chain(words).map(OsString::from))
    }

    /// Message about wrong arguments.
    fn usage_error(words: &[&str]) -> String {
        match parsed(words).err() {
            Some(Stop::Wrong(line)) => line,
            _ => String::new(),
        }
    }

    #[test]
    fn the_declared_options_are_consistent() {
        program().command().debug_assert();
    }

    #[test]
    fn without_a_command_the_study_runs() {
        for (words, write) in [(&[][..], false), (&["--write"], true), (&["study", "--write"], true)] {
            let found = parsed(words);
            assert!(matches!(&found, Ok(AnyCommand::Study(study)) if study.write == write), "{words:?}");
        }
    }

    #[test]
    fn a_usage_error_is_one_line_with_a_suggestion() {
        for (words, parts) in [
            (&["pakage"][..], &["'pakage'", "'package'"][..]),
            (&["package", "--integer"], &["'--integer'", "'--integers'", "package --help"]),
            (&["--quik"], &["'--quik'"]),
        ] {
            let line = usage_error(words);
            assert!(!line.contains('\n') && parts.iter().all(|part| line.contains(part)), "{words:?}: {line}");
        }
    }

    #[test]
    fn the_last_of_repeated_options_applies() {
        assert!(parsed(&["wheel", "--platforms", "linux64", "--platforms", "this-machine"]).is_ok());
    }
}

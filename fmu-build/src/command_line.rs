//! The command line: the commands of all modules, by their readers.

use std::ffi::OsString;

use anyhow::Result;
use clap::{Args as _, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use crate::fmu::BuildCommand;
use crate::study::StudyCommand;
use crate::tools::program::{Program, Stop};

/// How users call this program, and the laboratory.
pub const PROGRAM: &str = "cargo run --release --";
/// The same of the laboratory, which is a program of its own.
pub const LABORATORY: &str = "cargo run -p lab --release --";
/// The same without a command.
const PROGRAM_ALONE: &str = "cargo run --release";
/// How users call the Python package.
pub const PACKAGE: &str = "bevel-differential";
/// The commands of the Python package; those who type one here are told where it is.
pub const IN_THE_PACKAGE: [&str; 6] = ["scene", "loads", "report", "accuracy", "geometry", "pattern"];
/// The commands of the laboratory; those who type one here are told where it is.
pub const IN_THE_LABORATORY: [&str; 27] = [
    "cost",
    "solids",
    "stiffness",
    "survey",
    "compare-simulators",
    "peers",
    "compare-solvers",
    "foreign",
    "drivetrain",
    "patterns",
    "test-python",
    "drives",
    "test-wheel",
    "test-page",
    "zero-cost",
    "off",
    "prices",
    "real-time",
    "fuzz",
    "memcheck",
    "questions",
    "memory",
    "mutants",
    "coefficients",
    "hosts",
    "platforms",
    "sources",
];

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
            // answered while the command line is read
            Self::Help { .. } => Ok(()),
        }
    }
}

/// The command that `arguments`, the program's name first, ask for: the study if they name none.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<AnyCommand, Stop> {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let named = arguments.iter().skip(1).find(|word| *word != "help");
    if let Some(name) = named.and_then(|word| IN_THE_LABORATORY.iter().find(|name| word == *name)) {
        return Err(Stop::Wrong(format!("{name} is in the laboratory: {LABORATORY} {name}")));
    }
    if let Some(name) = named.and_then(|word| IN_THE_PACKAGE.iter().find(|name| word == *name)) {
        let there = if *name == "scene" { "plan" } else { name };
        return Err(Stop::Wrong(format!(
            "{name} is a command of the Python package now: {PACKAGE} {there}. In this checkout run {PROGRAM_ALONE} once, then \
             target/python/bin/{PACKAGE} {there}"
        )));
    }
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
             What measures and checks is in the laboratory: {LABORATORY} help"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(words: &[&str]) -> Result<AnyCommand, Stop> {
        parse(["fmu-build"].iter().chain(words).map(OsString::from))
    }

    /// What is wrong with the words.
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
    fn a_command_of_the_laboratory_is_told_where_it_is() {
        for words in [&["cost"][..], &["cost", "--quick"], &["help", "cost"]] {
            assert_eq!(usage_error(words), "cost is in the laboratory: cargo run -p lab --release -- cost");
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
    fn a_repeated_option_counts_last() {
        assert!(parsed(&["wheel", "--platforms", "linux64", "--platforms", "this-machine"]).is_ok());
    }
}

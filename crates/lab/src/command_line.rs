//! The command line of the laboratory.

use std::ffi::OsString;

use anyhow::Result;
use clap::{Parser, Subcommand};
use fmu_build::command_line::LABORATORY;
use fmu_build::tools::program::{Program, Stop};

use crate::all::AllCommand;
use crate::check::CheckCommand;
use crate::measure::MeasureCommand;

/// Commands of a room, each of which has a method `run`.
#[macro_export]
macro_rules! commands {
    ($(#[$told:meta])* $name:ident { $($(#[$more:meta])* $variant:ident($command:ty),)+ }) => {
        $(#[$told])*
        #[derive(clap::Subcommand)]
        #[allow(missing_docs)] // each command describes itself
        pub enum $name {
            $($(#[$more])* $variant($command)),+
        }

        impl $name {
            /// Runs the command.
            pub fn run(self) -> anyhow::Result<()> {
                match self {
                    $(Self::$variant(command) => command.run()),+
                }
            }
        }
    };
}

#[derive(Parser)]
#[command(name = "lab", bin_name = LABORATORY, version, disable_help_subcommand = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Option<AnyCommand>,
}

/// A command of any room.
#[derive(Subcommand)]
#[allow(missing_docs)] // each command describes itself
pub enum AnyCommand {
    #[command(flatten)]
    Measure(MeasureCommand),
    #[command(flatten)]
    Check(CheckCommand),
    All(AllCommand),
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
            Self::Measure(command) => command.run(),
            Self::Check(command) => command.run(),
            Self::All(command) => command.run(),
            // answered while the command line is read
            Self::Help { .. } => Ok(()),
        }
    }
}

/// The command that `arguments`, the program's name first, ask for: the overview if they name none.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<AnyCommand, Stop> {
    let program = program();
    match program.parse::<CommandLine>(arguments)?.command {
        None => Err(program.help::<CommandLine>(None)),
        Some(AnyCommand::Help { command }) => Err(program.help::<CommandLine>(command)),
        Some(command) => Ok(command),
    }
}

fn program() -> Program {
    let blank = || clap::Command::new("room");
    Program {
        call: LABORATORY,
        groups: vec![
            ("Measuring:", MeasureCommand::augment_subcommands(blank())),
            ("Checking:", CheckCommand::augment_subcommands(blank())),
        ],
        end: format!(
            "All of them in one go, in short forms, and one table: {LABORATORY} all\n\
             Options of a command: {LABORATORY} COMMAND --help"
        ),
    }
}

/// Names of all commands that measure or check.
#[cfg(test)]
pub(crate) fn names() -> Vec<String> {
    let groups = program().groups;
    let commands = groups.iter().flat_map(|(_, group)| group.get_subcommands());
    commands.map(|command| command.get_name().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use fmu_build::command_line::IN_THE_LABORATORY;

    use super::*;

    fn parsed(words: &[&str]) -> Result<AnyCommand, Stop> {
        parse(["lab"].iter().chain(words).map(OsString::from))
    }

    #[test]
    fn the_declared_options_are_consistent() {
        program().command::<CommandLine>().debug_assert();
    }

    #[test]
    fn users_are_told_of_every_command_and_of_former_names() {
        let told: BTreeSet<&str> = IN_THE_LABORATORY.into();
        let groups = program().groups;
        let commands = groups.iter().flat_map(|(_, group)| group.get_subcommands());
        let names: BTreeSet<&str> =
            commands.flat_map(|c| std::iter::once(c.get_name()).chain(c.get_all_aliases())).collect();
        assert_eq!(told, names);
    }

    #[test]
    fn former_names_still_work_and_are_not_shown() {
        for old in ["off", "peers", "foreign", "memory"] {
            assert!(parsed(&[old]).is_ok(), "{old}");
            assert!(!program().overview().contains(&format!("  {old} ")), "{old}");
        }
    }

    #[test]
    fn a_usage_error_is_one_line_with_a_suggestion() {
        let Some(Stop::Wrong(line)) = parsed(&["survei"]).err() else { panic!("no usage error") };
        assert!(line.contains("'survey'") && line.ends_with("(see cargo run -p lab --release -- --help)"), "{line}");
    }

    #[test]
    fn a_repeated_option_counts_last() {
        assert!(parsed(&["cost", "--quick", "--quick", "--out", "a", "--out", "b"]).is_ok());
    }
}

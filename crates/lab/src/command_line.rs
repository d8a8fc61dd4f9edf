//! Command line of the laboratory.

use std::ffi::OsString;

use anyhow::Result;
use clap::{Arg, ArgMatches};
use fmu_build::command_line::LABORATORY;
use fmu_build::tools::program::{Program, Stop};

use crate::all::AllCommand;
use crate::tools::command::Command;
use crate::{check, measure};

/// A command with the given options.
pub struct Called(Command, ArgMatches);

impl Called {
    /// Runs the command.
    pub fn run(&self) -> Result<()> {
        (self.0.run)(&self.1)
    }
}

/// Parses `arguments`, which start with the program's name. Without a command, the overview is shown.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Called, Stop> {
    let program = program();
    let mut matches = program.parse(arguments)?;
    let (name, options) = matches.remove_subcommand().unwrap_or(("help".to_owned(), ArgMatches::default()));
    match commands().into_iter().find(|command| command.declared.get_name() == name) {
        Some(command) => Ok(Called(command, options)),
        None => Err(program.help(options.try_get_one::<String>("command").ok().flatten().cloned())),
    }
}

fn commands() -> impl Iterator<Item = Command> {
    let all = Command::of("all", AllCommand::run);
    measure::commands().into_iter().chain(check::commands()).chain([all])
}

fn program() -> Program {
    let group = |commands: Vec<Command>| {
        clap::Command::new("group").subcommands(commands.into_iter().map(|command| command.declared))
    };
    let help = clap::Command::new("help").about("Shows this overview, or the options of a command").hide(true);
    Program {
        call: LABORATORY,
        root: clap::Command::new("lab")
            .version(env!("CARGO_PKG_VERSION"))
            .disable_help_subcommand(true)
            .subcommands(commands().map(|command| command.declared))
            .subcommand(help.arg(Arg::new("command").value_name("COMMAND").help("A command"))),
        groups: vec![("Measuring:", group(measure::commands())), ("Checking:", group(check::commands()))],
        end: format!(
            "All commands in short form, with one table of the results: {LABORATORY} all\n\
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
    use super::*;

    fn parsed(words: &[&str]) -> Result<Called, Stop> {
        parse(["lab"].iter().chain(words).map(OsString::from))
    }

    #[test]
    fn the_declared_options_are_consistent() {
        program().command().debug_assert();
    }

    #[test]
    fn a_usage_error_is_one_line_with_a_suggestion() {
        let Some(Stop::Wrong(line)) = parsed(&["survei"]).err() else { panic!("no usage error") };
        assert!(line.contains("'survey'") && line.ends_with("(see cargo run -p lab --release -- --help)"), "{line}");
    }

    #[test]
    fn the_last_of_repeated_options_applies() {
        assert!(parsed(&["survey", "--write", "--write", "--seed", "1", "--seed", "2"]).is_ok());
    }
}

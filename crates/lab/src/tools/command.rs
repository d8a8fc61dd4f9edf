//! A command of the laboratory: its declaration and the function that runs it.

use anyhow::Result;
use clap::{ArgMatches, Args};

/// Function that runs a command with the given options.
type Runs = dyn Fn(&ArgMatches) -> Result<()>;

/// A command.
pub struct Command {
    /// Name, options and help.
    pub declared: clap::Command,
    /// Function that runs the command.
    pub run: Box<Runs>,
}

impl Command {
    /// Creates a command whose options are a type.
    pub fn of<O: Args + 'static>(name: &'static str, run: fn(&O) -> Result<()>) -> Self {
        let declared = O::augment_args(clap::Command::new(name));
        Self { declared, run: Box::new(move |options| run(&O::from_arg_matches(options)?)) }
    }
}

//! A command of the laboratory: how it is called, and what runs it.

use anyhow::Result;
use clap::{ArgMatches, Args};

/// What runs a command with the options that were given.
type Runs = dyn Fn(&ArgMatches) -> Result<()>;

/// A command.
pub struct Command {
    /// Its name, its options, its help.
    pub declared: clap::Command,
    /// What runs it.
    pub run: Box<Runs>,
}

impl Command {
    /// One whose options are a type.
    pub fn of<O: Args + 'static>(name: &'static str, run: fn(&O) -> Result<()>) -> Self {
        let declared = O::augment_args(clap::Command::new(name));
        Self { declared, run: Box::new(move |options| run(&O::from_arg_matches(options)?)) }
    }
}

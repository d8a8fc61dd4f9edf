//! Program behind some commands of `crates/lab/lab.py`, which passes all options.

use std::process::ExitCode;

use clap::Parser;
use fmu_build::tools::program;
use lab::{fuzz::FuzzCommand, questions::QuestionsCommand, stiffness};

#[derive(Parser)]
enum Command {
    Fuzz(FuzzCommand),
    Questions(QuestionsCommand),
    /// Prints tables of the stiffness of each law and of 3-D finite elements
    Stiffness,
}

fn main() -> ExitCode {
    program::end(match Command::parse() {
        Command::Fuzz(command) => command.run(),
        Command::Questions(command) => command.run(),
        Command::Stiffness => stiffness::run(),
    })
}

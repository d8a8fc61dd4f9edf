//! Commands that fail if the library breaks a promise: about calls, ordinary drives, memory, effects that are off, steps in real
//! time, other hosts and platforms, compilers of C, browsers, machines without Rust. Two more look for changes of the source that
//! no test notices, and for wrong coefficients that the evidence does not show.

pub mod fuzz;
pub mod memcheck;
pub mod page;
mod platforms;
pub mod python_tests;
pub mod questions;
mod scripts;
mod sources;

use crate::tools::command::Command;

/// The commands that check.
pub fn commands() -> Vec<Command> {
    vec![
        Command::of("test-python", python_tests::TestPythonCommand::run),
        scripts::DRIVES.command(),
        scripts::WHEEL.command(),
        Command::of("test-page", page::TestPageCommand::run),
        scripts::ZERO_COST.command(),
        scripts::REAL_TIME.command(),
        Command::of("fuzz", fuzz::FuzzCommand::run),
        Command::of("questions", questions::QuestionsCommand::run),
        Command::of("memcheck", memcheck::MemcheckCommand::run),
        scripts::MUTANTS.command(),
        scripts::COEFFICIENTS.command(),
        scripts::HOSTS.command(),
        scripts::PLATFORMS.command(),
        scripts::SOURCES.command(),
    ]
}

//! Commands that fail if the library breaks a promise. They check calls, ordinary drives, memory, inactive effects,
//! real-time steps, other hosts and platforms, C compilers, browsers, and machines without Rust. Two more commands look
//! for source changes that no test notices, and for wrong coefficients that the evidence does not reveal.

pub mod fuzz;
pub mod memcheck;
pub mod page;
mod platforms;
pub mod python_tests;
pub mod questions;
mod scripts;
mod sources;

use crate::tools::command::Command;

/// Commands that check.
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

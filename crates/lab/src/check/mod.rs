//! What checks: commands that fail if the library breaks a promise about calls, memory, effects that are off, steps in real
//! time, other hosts, other platforms, a browser or a machine without Rust; and one that looks
//! for changes that no test notices.

pub mod fuzz;
pub mod hosts;
pub mod instructions;
pub mod memcheck;
pub mod mutants;
pub mod page;
pub mod platforms;
pub mod python_tests;
pub mod questions;
pub mod wheel;

use anyhow::Result;
use clap::Subcommand;

/// A command that checks.
#[derive(Subcommand)]
#[allow(missing_docs)] // each command describes itself
pub enum CheckCommand {
    TestPython(python_tests::TestPythonCommand),
    TestWheel(wheel::TestWheelCommand),
    TestPage(page::TestPageCommand),
    #[command(alias = "off")]
    ZeroCost(instructions::ZeroCostCommand),
    RealTime(instructions::RealTimeCommand),
    Fuzz(fuzz::FuzzCommand),
    Questions(questions::QuestionsCommand),
    #[command(alias = "memory")]
    Memcheck(memcheck::MemcheckCommand),
    Mutants(mutants::MutantsCommand),
    Hosts(hosts::HostsCommand),
    Platforms(platforms::PlatformsCommand),
}

impl CheckCommand {
    /// Runs the command.
    pub fn run(self) -> Result<()> {
        match self {
            Self::TestPython(command) => command.run(),
            Self::TestWheel(command) => command.run(),
            Self::TestPage(command) => command.run(),
            Self::ZeroCost(command) => command.run(),
            Self::RealTime(command) => command.run(),
            Self::Fuzz(command) => command.run(),
            Self::Questions(command) => command.run(),
            Self::Memcheck(command) => command.run(),
            Self::Mutants(command) => command.run(),
            Self::Hosts(command) => command.run(),
            Self::Platforms(command) => command.run(),
        }
    }
}

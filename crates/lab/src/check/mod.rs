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

crate::commands! {
    /// A command that checks.
    CheckCommand {
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
}

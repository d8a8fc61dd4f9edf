//! Builds the FMU: its description, the libraries for each platform and their tool chains, licences, documentation, the
//! archive, and the Python package around it. Commands: `package`, `wheel`, `page`, `describe`, `evidence`,
//! `toolchains`.

pub mod archive;
pub mod dependencies;
pub mod describe;
pub mod describe3;
pub mod documentation;
pub mod effect_list;
pub mod evidence;
pub mod evidence_command;
pub mod libraries;
pub mod licences;
pub mod package;
pub mod page;
pub mod plain_types;
pub mod sources;
pub mod terminals;
pub mod toolchains;
mod variables_page;
pub mod wasm;
pub mod wheel;

use anyhow::Result;
use clap::Subcommand;

/// A command that builds the FMU or its parts.
#[derive(Subcommand)]
#[allow(missing_docs)] // each command describes itself
pub enum BuildCommand {
    Package(package::PackageCommand),
    Wheel(wheel::WheelCommand),
    Page(page::PageCommand),
    Describe(describe::DescribeCommand),
    Evidence(evidence_command::EvidenceCommand),
    Toolchains(toolchains::ToolchainsCommand),
}

impl BuildCommand {
    /// Runs the command.
    pub fn run(self) -> Result<()> {
        match self {
            Self::Package(command) => command.run(),
            Self::Wheel(command) => command.run(),
            Self::Page(command) => command.run(),
            Self::Describe(command) => command.run(),
            Self::Evidence(command) => command.run(),
            Self::Toolchains(command) => command.run(),
        }
    }
}

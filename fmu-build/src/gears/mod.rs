//! What a user of gears runs: the study, scenes and their tooth loads, what accuracy costs, dimensions and solids, contact
//! patterns, reports. Commands: `study`, `scene`, `loads`, `report`, `accuracy`, `geometry`, `pattern`.

pub mod accuracy;
pub mod geometry;
pub mod pattern;
pub mod report;
pub mod scene;
pub mod study;

use anyhow::Result;
use clap::Subcommand;

/// A command for users of the gears.
#[derive(Subcommand)]
#[allow(missing_docs)] // each command describes itself
pub enum GearsCommand {
    Study(study::StudyCommand),
    Scene(scene::command::SceneCommand),
    Loads(scene::command::LoadsCommand),
    Report(report::ReportCommand),
    Accuracy(accuracy::command::AccuracyCommand),
    Geometry(geometry::command::GeometryCommand),
    Pattern(pattern::PatternCommand),
}

impl GearsCommand {
    /// Runs the command.
    pub fn run(self) -> Result<()> {
        match self {
            Self::Study(command) => command.run(),
            Self::Scene(command) => command.run(),
            Self::Loads(command) => command.run(),
            Self::Report(command) => command.run(),
            Self::Accuracy(command) => command.run(),
            Self::Geometry(command) => command.run(),
            Self::Pattern(command) => command.run(),
        }
    }
}

//! What measures: time and error of this program's fidelities and methods, of solid teeth, of couplings of FMUs, and of other
//! programs on the same cases. Each command writes figures, and a document with `--write`.

pub mod compare;
pub mod cost;
pub mod pattern;
pub mod prices;
pub mod solids;
pub mod stiffness;
pub mod survey;

use anyhow::Result;
use clap::Subcommand;

/// A command that measures.
#[derive(Subcommand)]
#[allow(missing_docs)] // each command describes itself
pub enum MeasureCommand {
    Cost(cost::CostCommand),
    Solids(solids::SolidsCommand),
    Stiffness(stiffness::StiffnessCommand),
    Survey(survey::SurveyCommand),
    #[command(alias = "peers")]
    CompareSimulators(compare::CompareSimulatorsCommand),
    #[command(alias = "foreign")]
    CompareSolvers(compare::CompareSolversCommand),
    Drivetrain(compare::DrivetrainCommand),
    Pattern(pattern::PatternCommand),
    Prices(prices::PricesCommand),
}

impl MeasureCommand {
    /// Runs the command.
    pub fn run(self) -> Result<()> {
        match self {
            Self::Cost(command) => command.run(),
            Self::Solids(command) => command.run(),
            Self::Stiffness(command) => command.run(),
            Self::Survey(command) => command.run(),
            Self::CompareSimulators(command) => command.run(),
            Self::CompareSolvers(command) => command.run(),
            Self::Drivetrain(command) => command.run(),
            Self::Pattern(command) => command.run(),
            Self::Prices(command) => command.run(),
        }
    }
}

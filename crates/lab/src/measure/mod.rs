//! What measures: time and error of this program's fidelities and methods, of solid teeth, of couplings of FMUs, and of other
//! programs on the same cases. Each command writes figures, and a document with `--write`.

pub mod compare;
pub mod cost;
pub mod pattern;
pub mod prices;
pub mod solids;
pub mod stiffness;
pub mod survey;

crate::commands! {
    /// A command that measures.
    MeasureCommand {
        Cost(cost::CostCommand),
        Solids(solids::SolidsCommand),
        Stiffness(stiffness::StiffnessCommand),
        Survey(survey::SurveyCommand),
        #[command(alias = "peers")]
        CompareSimulators(compare::CompareSimulatorsCommand),
        #[command(alias = "foreign")]
        CompareSolvers(compare::CompareSolversCommand),
        Drivetrain(compare::DrivetrainCommand),
        Patterns(pattern::PatternsCommand),
        Prices(prices::PricesCommand),
    }
}

//! Measurements: time and error of this program's fidelities and methods, of solid teeth, of couplings of FMUs, and of
//! other programs on the same cases. Each command writes results, and a document with `--write`.

mod scripts;
pub mod stiffness;

use crate::tools::command::Command;

/// Commands that measure.
pub fn commands() -> Vec<Command> {
    vec![
        scripts::COST.command(),
        scripts::SOLIDS.command(),
        Command::of("stiffness", stiffness::StiffnessCommand::run),
        scripts::SURVEY.command(),
        scripts::SIMULATORS.command(),
        scripts::SOLVERS.command(),
        scripts::DRIVETRAIN.command(),
        scripts::PATTERNS.command(),
        scripts::PRICES.command(),
        scripts::WORDS.command(),
    ]
}

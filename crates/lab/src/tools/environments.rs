//! The Python environments of comparisons with other programs and of tests, each beside its results.

use anyhow::Result;
use fmu_build::tools::paths::target;
use fmu_build::tools::python::{Environment, Wanted};

use super::places;

/// The programs to compare with.
pub fn simulators(report: &dyn Fn(&str)) -> Result<Environment> {
    let requirements = places::simulators_benchmark().join("requirements.txt");
    Wanted { folder: target().join("peers").join("venv"), requirements, holds: "MuJoCo, Drake, fmpy" }.made(report)
}

/// Other solvers.
pub fn solvers(report: &dyn Fn(&str)) -> Result<Environment> {
    let requirements = places::solvers_benchmark().join("requirements.txt");
    Wanted { folder: target().join("foreign"), requirements, holds: "scipy, scikit-SUNDAE" }.made(report)
}

/// FMI hosts.
pub fn hosts(report: &dyn Fn(&str)) -> Result<Environment> {
    let requirements = places::hosts().join("requirements.txt");
    let holds = "fmpy, libcosimpy, ecospy, fmuloader, FMU Manipulation Toolbox";
    Wanted { folder: target().join("hosts").join("venv"), requirements, holds }.made(report)
}

/// What reads the source.
pub fn parser(report: &dyn Fn(&str)) -> Result<Environment> {
    let requirements = places::script("mutants").join("requirements.txt");
    Wanted { folder: target().join("mutants").join("venv"), requirements, holds: "tree-sitter" }.made(report)
}

/// What drives a browser.
pub fn browser(report: &dyn Fn(&str)) -> Result<Environment> {
    let requirements = places::browser_tests().join("requirements.txt");
    Wanted { folder: target().join("browser"), requirements, holds: "playwright, pytest, fmpy, numpy" }.made(report)
}

/// What builds the other parts of a drivetrain and couples them.
pub fn drivetrain(report: &dyn Fn(&str)) -> Result<Environment> {
    let requirements = places::drivetrain().join("requirements.txt");
    Wanted { folder: target().join("drivetrain").join("venv"), requirements, holds: "pythonfmu, fmpy, libcosim" }
        .made(report)
}

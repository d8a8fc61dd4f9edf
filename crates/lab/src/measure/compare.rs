//! This program beside others: simulators on the study's two cases, solvers on the same equations, and a whole drivetrain of FMUs
//! beside all its equations at once. Each is one run and one page of tables.

use anyhow::Result;
use clap::Args;

use crate::tools::places;
use crate::tools::scripted::{Document, Script, arguments};
use fmu_build::fmu::{package, plain_types};
use fmu_build::tools::paths;

const SIMULATORS: Document = Document {
    file: "docs/compare.md",
    marks: ["<!-- peers:begin -->", "<!-- peers:end -->"],
    pictures: &["peers.png"],
};
const SOLVERS: Document =
    Document { file: "docs/compare.md", marks: ["<!-- foreign:begin -->", "<!-- foreign:end -->"], pictures: &[] };
const DRIVETRAIN: Document = Document {
    file: "docs/coupling.md",
    marks: ["<!-- drivetrain:begin -->", "<!-- drivetrain:end -->"],
    pictures: &["drivetrain_signals.png", "drivetrain_launch.png", "drivetrain_errors.png"],
};
/// The crate with the equations as a library.
const EQUATIONS: &str = "foreign-solvers";

/// Compares MuJoCo and Drake with this program on the study's cases (a few minutes)
#[derive(Args, Clone, Debug)]
pub struct CompareSimulatorsCommand {
    /// A few rows, once
    #[arg(long)]
    quick: bool,
    /// Also renew docs/compare.md
    #[arg(long)]
    write: bool,
}

/// Compares scipy's LSODA and Radau and CVODE with this program's method on the same equations (many minutes)
#[derive(Args, Clone, Debug)]
pub struct CompareSolversCommand {
    /// Two cases, once
    #[arg(long)]
    quick: bool,
    /// Also renew docs/compare.md
    #[arg(long)]
    write: bool,
}

/// Couples a whole drivetrain from FMUs and compares it with all its equations at once (many minutes)
#[derive(Args, Clone, Debug)]
pub struct DrivetrainCommand {
    /// Ideal gears only, in a minute and a half
    #[arg(long, conflicts_with = "write")]
    quick: bool,
    /// Also renew docs/coupling.md
    #[arg(long)]
    write: bool,
}

impl CompareSimulatorsCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        let folder = paths::target().join("peers");
        let script = Script::of(&places::SIMULATORS, places::SIMULATORS.folder().join("run.py"), "comparing", &folder);
        SIMULATORS.make(&script, self.write, |progress| {
            progress.stage("packaging the FMU");
            Ok(arguments([package::package()?, folder], self.quick))
        })
    }
}

impl CompareSolversCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        let folder = paths::target().join("cost");
        let script = Script::of(&places::SOLVERS, places::SOLVERS.folder().join("compare.py"), "comparing", &folder);
        SOLVERS.make(&script, self.write, |progress| {
            progress.stage("building the equations as a library");
            Ok(arguments([package::build_library(EQUATIONS)?, folder], self.quick))
        })
    }
}

impl DrivetrainCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        let folder = paths::target().join("drivetrain");
        let script = Script::of(&places::DRIVETRAIN, places::DRIVETRAIN.folder().join("run.py"), "coupling", &folder);
        DRIVETRAIN.make(&script, self.write, |progress| {
            progress.stage("packaging the FMU");
            // libcosim sets no enumerations, and the scene is made of them
            let fmu = plain_types::package(&package::package()?)?;
            progress.stage("building the equations as a library");
            Ok(arguments([fmu, package::build_library(EQUATIONS)?, folder], self.quick))
        })
    }
}

//! The whole drivetrain of examples/drivetrain, coupled from FMUs: one run and its tables.

use std::ffi::OsString;

use anyhow::Result;
use clap::Args;

use crate::tools::scripted::Document;
use crate::tools::{environments, places};
use fmu_build::fmu::{package, plain_types};
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;

const DOCUMENT: Document = Document {
    file: "docs/coupling.md",
    marks: ["<!-- drivetrain:begin -->", "<!-- drivetrain:end -->"],
    pictures: &["drivetrain_signals.png", "drivetrain_launch.png", "drivetrain_errors.png"],
};

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

impl DrivetrainCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        run(self.quick, self.write)
    }
}

fn run(quick: bool, write: bool) -> Result<()> {
    let progress = Progress::start("looking for Python");
    let environment = environments::drivetrain(|what| progress.stage(what))?;
    progress.stage("packaging the FMU");
    // libcosim sets no enumerations, and the scene is made of them
    let fmu = plain_types::package(&package::package()?)?;
    progress.stage("building the equations as a library");
    let library = package::build_library("foreign-solvers")?;
    let folder = paths::target().join("drivetrain");
    let mut arguments: Vec<OsString> = vec![fmu.into(), library.into(), folder.clone().into()];
    if quick {
        arguments.push("--quick".into());
    }
    let script = places::drivetrain().join("run.py");
    DOCUMENT.make(progress, "coupling", (&environment, &script, &arguments), &folder, write)
}

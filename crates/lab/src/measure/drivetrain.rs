//! The whole drivetrain of examples/drivetrain, coupled from FMUs: one run and its tables.

use std::ffi::OsString;
use std::fs;

use anyhow::{Context, Result};
use clap::Args;

use crate::tools::{environments, places};
use fmu_build::fmu::{package, plain_types};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::table::for_terminal;
use fmu_build::tools::{paths, script, sections};

/// The document with the tables, their place, and the pictures.
const DOCUMENT: &str = "docs/coupling.md";
const MARKS: [&str; 2] = ["<!-- drivetrain:begin -->", "<!-- drivetrain:end -->"];
const PICTURES: [&str; 3] = ["drivetrain_signals.png", "drivetrain_launch.png", "drivetrain_errors.png"];

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
    progress.begin_bar("coupling");
    let tables = script::run(&environment, &places::drivetrain().join("run.py"), &arguments, &progress)?;
    progress.finish();
    print!("{}", for_terminal(&tables));
    println!("\nresults: {}", paths::shown(&folder));
    if write {
        sections::renew(DOCUMENT, MARKS, &tables)?;
        let figures = paths::workspace().join("docs").join("figures");
        for picture in PICTURES {
            fs::copy(folder.join(picture), figures.join(picture))
                .with_context(|| format!("{picture} cannot be copied to docs/figures"))?;
        }
        println!("renewed: {DOCUMENT} and its pictures in docs/figures");
    }
    Ok(())
}

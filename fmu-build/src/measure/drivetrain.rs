//! The whole drivetrain of examples/drivetrain, coupled from FMUs: their own Python environment, one run, its tables.

use std::ffi::OsString;
use std::fs;

use anyhow::{Context, Result, bail};

use crate::fmu::{package, plain_types};
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script, sections};

/// The document with the tables, their place, and the pictures.
const DOCUMENT: &str = "docs/coupling.md";
const MARKS: [&str; 2] = ["<!-- drivetrain:begin -->", "<!-- drivetrain:end -->"];
const PICTURES: [&str; 3] = ["drivetrain_signals.png", "drivetrain_launch.png", "drivetrain_errors.png"];

/// Runs examples/drivetrain/run.py and prints its tables; `quick`: ideal gears, few steps; `write`: also renews the
/// document.
pub fn run(quick: bool, write: bool) -> Result<()> {
    if quick && write {
        bail!("drivetrain --write takes the full run: leave --quick out");
    }
    let progress = Progress::start("looking for Python");
    let environment = Environment::for_drivetrain(|what| progress.tell(what))?;
    progress.tell("packaging the FMU");
    // libcosim sets no enumerations, and the scene is made of them
    let fmu = plain_types::package(&package::package()?)?;
    progress.tell("building the equations as a library");
    let library = package::build_library("foreign-solvers")?;
    let folder = paths::target().join("drivetrain");
    let mut arguments: Vec<OsString> = vec![fmu.into(), library.into(), folder.clone().into()];
    if quick {
        arguments.push("--quick".into());
    }
    progress.begin_bar("coupling");
    let tables = script::run(&environment, &paths::drivetrain().join("run.py"), &arguments, &progress)?;
    progress.finish();
    print!("{tables}");
    println!("\nresults: {}", paths::shown(&folder));
    if write {
        sections::renew(DOCUMENT, MARKS, &tables)?;
        let images = paths::workspace().join("docs").join("images");
        for picture in PICTURES {
            fs::copy(folder.join(picture), images.join(picture))
                .with_context(|| format!("{picture} cannot be copied to docs/images"))?;
        }
        println!("renewed: {DOCUMENT} and its pictures in docs/images");
    }
    Ok(())
}

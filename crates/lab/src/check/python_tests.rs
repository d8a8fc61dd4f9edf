//! Python tests on the packaged FMU.

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;
use clap::Args;

use fmu_build::fmu::{libraries, package};
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python;
use fmu_build::tools::python::Environment;

/// Program for users.
const PROGRAM: &str = "fmu-build";

/// Packages the FMU and runs the Python tests on it
#[derive(Args, Clone, Debug)]
pub struct TestPythonCommand {
    /// Arguments for pytest
    #[arg(value_name = "ARG", trailing_var_arg = true, allow_hyphen_values = true)]
    pytest: Vec<OsString>,
}

impl TestPythonCommand {
    /// Runs pytest and prints its report.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let environment = Environment::complete(|what| progress.stage(what))?;
        progress.stage("packaging the FMU");
        let fmu = package::package()?;
        progress.stage("building the program");
        let program = program()?;
        progress.stage("running pytest");
        let report = environment.test(&fmu, &program, &self.pytest)?;
        progress.finish();
        print!("{report}");
        Ok(())
    }
}

/// Builds the program for users with the profile of the user's first command. The tests call it.
fn program() -> Result<PathBuf> {
    let target = paths::target();
    let mut cargo = Command::new(libraries::cargo());
    cargo.current_dir(paths::workspace()).args(["build", "--release", "--quiet", "--bin", PROGRAM]);
    python::finish(cargo.arg("--target-dir").arg(&target), "the program cannot be built")?;
    Ok(target.join("release").join(PROGRAM).with_extension(env::consts::EXE_EXTENSION))
}

//! The Python tests, run on the packaged FMU.

use std::env;
use std::ffi::OsString;

use anyhow::{Context, Result};
use clap::Args;

use crate::fmu::package;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;

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
        let environment = Environment::ready(|what| progress.stage(what))?;
        progress.stage("packaging the FMU");
        let fmu = package::package()?;
        let program = env::current_exe().context("this program does not know its own file")?;
        progress.stage("running pytest");
        let report = environment.test(&fmu, &program, &self.pytest)?;
        progress.finish();
        print!("{report}");
        Ok(())
    }
}

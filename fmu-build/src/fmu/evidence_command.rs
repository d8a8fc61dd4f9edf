//! Command that recreates the evidence with the present FMU.

use anyhow::Result;
use clap::Args;

use crate::fmu::{evidence, package};
use crate::tools::lock::Lock;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script};

/// Script that creates the files.
const SCRIPT: &str = "fmu-build/python/evidence.py";
/// Scenes only for the evidence. They use the laws, levels of gear contact and effects that no shipped scene uses.
const SCENES: &str = "fmu-build/evidence";

/// Simulates the shipped scenes and those of fmu-build/evidence, and writes their results to modelDescription/evidence, for `bevel-differential verify`
#[derive(Args, Clone, Debug)]
pub struct EvidenceCommand {}

impl EvidenceCommand {
    /// Writes the files and prints the script's summary.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let environment = Environment::ready(|what| progress.stage(what))?;
        progress.stage("packaging the FMU");
        let fmu = package::package()?;
        progress.begin_bar("simulating");
        let _alone = Lock::of(&paths::target().join("evidence"))?;
        let made = paths::evidence().with_file_name(".evidence.part");
        let mut command = environment.command();
        command.arg(paths::workspace().join(SCRIPT)).arg(&fmu).arg(paths::workspace().join(SCENES)).arg(&made);
        let output = script::follow(&mut command, SCRIPT, &progress)?;
        evidence::take(&made)?;
        progress.finish();
        print!("{output}");
        println!("{} is renewed; the next packaging takes it into the FMU", paths::shown(&paths::evidence()));
        Ok(())
    }
}

//! This program and the simulators MuJoCo and Drake on the study's two cases: one run, one table.

use std::ffi::OsString;

use anyhow::Result;
use clap::Args;

use crate::tools::scripted::Document;
use crate::tools::{environments, places};
use fmu_build::fmu::package;
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;

const DOCUMENT: Document = Document {
    file: "docs/compare.md",
    marks: ["<!-- peers:begin -->", "<!-- peers:end -->"],
    pictures: &["peers.png"],
};

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

impl CompareSimulatorsCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        run(self.quick, self.write)
    }
}

fn run(quick: bool, write: bool) -> Result<()> {
    let progress = Progress::start("looking for Python");
    let environment = environments::simulators(|what| progress.stage(what))?;
    progress.stage("packaging the FMU");
    let fmu = package::package()?;
    let folder = paths::target().join("peers");
    let mut arguments: Vec<OsString> = vec![fmu.into(), folder.clone().into()];
    if quick {
        arguments.push("--quick".into());
    }
    let script = places::simulators_benchmark().join("run.py");
    DOCUMENT.make(progress, "comparing", (&environment, &script, &arguments), &folder, write)
}

//! This program's method and other solvers on the same equations: one run, one table.

use std::ffi::OsString;

use anyhow::Result;
use clap::Args;

use crate::tools::scripted::Document;
use crate::tools::{environments, places};
use fmu_build::fmu::package;
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;

const DOCUMENT: Document = Document {
    file: "docs/foreign-solvers.md",
    marks: ["<!-- foreign:begin -->", "<!-- foreign:end -->"],
    pictures: &[],
};

/// Compares scipy's LSODA and Radau and CVODE with this program's method on the same equations (many minutes)
#[derive(Args, Clone, Debug)]
pub struct CompareSolversCommand {
    /// Two cases, once
    #[arg(long)]
    quick: bool,
    /// Also renew docs/foreign-solvers.md
    #[arg(long)]
    write: bool,
}

impl CompareSolversCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        run(self.quick, self.write)
    }
}

fn run(quick: bool, write: bool) -> Result<()> {
    let progress = Progress::start("looking for Python");
    let environment = environments::solvers(|what| progress.stage(what))?;
    progress.stage("building the equations as a library");
    let library = package::build_library("foreign-solvers")?;
    let folder = paths::target().join("cost");
    let mut arguments: Vec<OsString> = vec![library.into(), folder.clone().into()];
    if quick {
        arguments.push("--quick".into());
    }
    let script = places::solvers_benchmark().join("compare.py");
    DOCUMENT.make(progress, "comparing", (&environment, &script, &arguments), &folder, write)
}

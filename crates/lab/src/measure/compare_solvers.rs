//! This program's method and other solvers on the same equations: one run, one table.

use std::ffi::OsString;

use anyhow::Result;
use clap::Args;

use crate::tools::{environments, places};
use fmu_build::fmu::package;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::table::for_terminal;
use fmu_build::tools::{paths, script, sections};

/// The document with the table, and the table's place.
const DOCUMENT: &str = "docs/foreign-solvers.md";
const MARKS: [&str; 2] = ["<!-- foreign:begin -->", "<!-- foreign:end -->"];

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
    progress.begin_bar("comparing");
    let table = script::run(&environment, &places::solvers_benchmark().join("compare.py"), &arguments, &progress)?;
    progress.finish();
    print!("{}", for_terminal(&table));
    println!("\nresults: {}", paths::shown(&folder.join("foreign.csv")));
    if write {
        sections::renew(DOCUMENT, MARKS, &table)?;
        println!("renewed: {DOCUMENT}");
    }
    Ok(())
}

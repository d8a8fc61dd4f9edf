//! This program and the simulators MuJoCo and Drake on the study's two cases: one run, one table.

use std::ffi::OsString;
use std::fs;

use anyhow::{Context, Result};
use clap::Args;

use crate::tools::{environments, places};
use fmu_build::fmu::package;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::table::for_terminal;
use fmu_build::tools::{paths, script, sections};

/// The document, the marks of its table, and its picture.
const DOCUMENT: &str = "docs/compare.md";
const MARKS: [&str; 2] = ["<!-- peers:begin -->", "<!-- peers:end -->"];
const PICTURE: &str = "peers.png";

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
    progress.begin_bar("comparing");
    let table = script::run(&environment, &places::simulators_benchmark().join("run.py"), &arguments, &progress)?;
    progress.finish();
    print!("{}", for_terminal(&table));
    println!("\nresults: {}", paths::shown(&folder));
    if write {
        sections::renew(DOCUMENT, MARKS, &table)?;
        let figures = paths::workspace().join("docs").join("figures");
        fs::copy(folder.join(PICTURE), figures.join(PICTURE))
            .context("the picture cannot be copied to docs/figures")?;
        println!("renewed: {DOCUMENT}, docs/figures/{PICTURE}");
    }
    Ok(())
}

//! What accuracy costs, measured on this machine by python/cost.py: methods over tolerances and steps, the communication step of a
//! coupled run, decisions, and the ladder of fidelities; each is a CSV file and a picture. The laws over gears and loads are
//! compared here ([`laws`]).

pub mod laws;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;

use crate::tools::places;
use crate::tools::scripted::arguments;
use answers::text::table::for_terminal;
use fmu_build::fmu::package;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use fmu_build::tools::{paths, script, sections};

/// The document, and the marks of the summary and of the decisions.
const DOCUMENT: &str = "docs/cost.md";
const MARKS: [&str; 2] = ["<!-- cost:begin -->", "<!-- cost:end -->"];
const DECISIONS: [&str; 2] = ["<!-- decisions:begin -->", "<!-- decisions:end -->"];
/// Share of the bar that belongs to the laws; the rest is that of cost.py.
const LAWS: f64 = 0.1;

/// Measures what accuracy costs: methods, fidelities, settings and communication steps
#[derive(Args, Clone, Debug)]
pub struct CostCommand {
    /// Take under a minute: fewer tolerances, steps and runs
    #[arg(long)]
    quick: bool,
    /// Make only the table of decisions and that of the laws
    #[arg(long, conflicts_with = "quick")]
    decisions: bool,
    /// Also renew docs/cost.md and its figures
    #[arg(long)]
    write: bool,
    /// Folder for figures and CSV [default: target/cost]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl CostCommand {
    /// Measures, draws and prints the summary.
    pub fn run(&self) -> Result<()> {
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("cost"));
        let progress = Progress::start("looking for Python");
        // Python first: what the user has to install should not come out after minutes of measuring
        let environment = Environment::ready(|what| progress.stage(what))?;
        paths::create_folder(&folder)?;
        let mut given = vec![folder.clone()];
        if !self.decisions {
            progress.stage("packaging the FMU");
            given.insert(0, package::package()?);
        }
        progress.begin_bar("measuring");
        let mut decisions = String::new();
        if !self.quick {
            decisions = laws::measure(&mut |done, what| progress.advance(LAWS * done, what))?;
        }
        let given = arguments(given, self.quick);
        let summary = script::run(&environment, &places::script("cost.py"), &given, &progress)?;
        progress.finish();
        let table = fs::read_to_string(folder.join("decisions.md")).context("decisions.md cannot be read")?;
        decisions = table.replacen("LAWS\n", &decisions, 1);
        println!("{}\n{}", for_terminal(&decisions), for_terminal(&summary));
        let files = files(&folder)?;
        println!("files:");
        files.iter().for_each(|file| println!("  {}", paths::shown(file)));
        if self.write {
            for (text, marks) in [(&decisions, DECISIONS), (&summary, MARKS)] {
                if !text.trim().is_empty() {
                    sections::renew(DOCUMENT, marks, text)?;
                }
            }
            copy_pictures(&files)?;
            println!("renewed: {DOCUMENT}, docs/figures");
        }
        Ok(())
    }
}

/// Tables and pictures of a folder, by name.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).with_context(|| format!("{} cannot be read", folder.display()))?;
    let known = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "png" || ending == "csv");
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).filter(known).collect();
    files.sort();
    Ok(files)
}

fn copy_pictures(files: &[PathBuf]) -> Result<()> {
    let figures = paths::workspace().join("docs").join("figures");
    for path in files.iter().filter(|path| path.extension().is_some_and(|ending| ending == "png")) {
        let name = path.file_name().unwrap_or_default();
        fs::copy(path, figures.join(name)).with_context(|| format!("{} cannot be copied", path.display()))?;
    }
    Ok(())
}

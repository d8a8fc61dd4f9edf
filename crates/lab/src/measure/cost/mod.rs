//! What accuracy costs, measured on this machine.
//!
//! 1. Work and precision: all methods and fidelities over tolerances and steps ([`work_precision`]).
//! 2. The communication step of a coupled run, with and without rollback ([`communication`]).
//! 3. The laws over gears and loads ([`laws`]).
//! 4. Decisions: the cheapest setting for a quantity and an accuracy, and the ladder of fidelities: what each gets right, and
//!    what it costs. Both are measured by python/cost.py, which also draws all pictures and sums up.

pub mod cases;
pub mod communication;
pub mod coupling;
pub mod laws;
pub mod measure;
pub mod reference;
pub mod vehicle;
pub mod work_precision;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Args;

use crate::tools::machine::machine;
use crate::tools::places;
use crate::tools::scripted::arguments;
use answers::text::csv_file::CsvFile;
use answers::text::table::for_terminal;
use fmu_build::fmu::package;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use fmu_build::tools::{paths, script, sections};

/// The document and the marks of the summary.
const DOCUMENT: &str = "docs/cost.md";
const MARKS: [&str; 2] = ["<!-- cost:begin -->", "<!-- cost:end -->"];
const DECISIONS: [&str; 2] = ["<!-- decisions:begin -->", "<!-- decisions:end -->"];
/// Share of the bar that belongs to methods, couplings and laws; the rest is that of cost.py.
const SHARES: [f64; 3] = [0.5, 0.15, 0.05];

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

/// How much is measured.
pub struct CostPlan {
    /// Relative tolerances.
    pub tolerances: &'static [f64],
    /// Steps of the method with fixed ones [s].
    pub fixed_steps: &'static [f64],
    /// Communication steps, each an exact part of 0.1 s [s].
    pub communication_steps: &'static [f64],
    /// Runs of each setting.
    pub runs: usize,
    /// Seconds on the processor after which a run is given up.
    pub patience: f64,
    /// Whether the table of the laws is left out.
    pub short: bool,
}

const FULL: CostPlan = CostPlan {
    tolerances: &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10],
    fixed_steps: &[1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6],
    communication_steps: &[1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1],
    runs: 15,
    patience: 10.0,
    short: false,
};

const QUICK: CostPlan = CostPlan {
    tolerances: &[1e-3, 1e-6, 1e-9],
    fixed_steps: &[1e-4, 1e-5],
    communication_steps: &[1e-4, 1e-3, 1e-2, 1e-1],
    runs: 5,
    patience: 0.5,
    short: true,
};

impl CostCommand {
    /// Measures, draws and prints the summary.
    pub fn run(&self) -> Result<()> {
        let form = if self.quick { QUICK } else { FULL };
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("cost"));
        let begun = Instant::now();
        let progress = Progress::start("looking for Python");
        let report = |part: usize, done: f64, what: &str| {
            let done = SHARES[..part].iter().sum::<f64>() + SHARES[part] * done;
            progress.advance(done, &format!("{what}{}", left(begun.elapsed().as_secs_f64(), done)));
        };
        paths::create_folder(&folder)?;
        // Python first: what the user has to install should not come out after minutes of measuring
        let environment = Environment::ready(|what| progress.stage(what))?;
        let mut given = vec![folder.clone()];
        if !self.decisions {
            progress.stage("packaging the FMU");
            given.insert(0, package::package()?);
            progress.begin_bar("measuring");
            let found = work_precision::measure(&form, &mut |done, what| report(0, done, what))?;
            save(&folder, "work_precision.csv", &found.csv()?)?;
            let couplings = communication::measure(&form, &mut |done, what| report(1, done, what))?;
            save(&folder, "communication_step.csv", &couplings)?;
        } else {
            progress.begin_bar("measuring");
        }
        let laws = if form.short { None } else { Some(laws::measure(&mut |done, what| report(2, done, what))?) };
        let given = arguments(given, self.quick);
        let summary = script::run(&environment, &places::script("cost.py"), &given, &progress)?;
        progress.finish();
        let decisions = fs::read_to_string(folder.join("decisions.md")).context("decisions.md cannot be read")?;
        let tables: Vec<String> = [decisions].into_iter().chain(laws).collect();
        self.conclude(&tables.join("\n"), &summary, &folder)
    }

    /// Prints what was found, and renews the document.
    fn conclude(&self, decisions: &str, summary: &str, folder: &Path) -> Result<()> {
        println!("{}\n{}", for_terminal(decisions), for_terminal(summary));
        let mut files = files(folder)?;
        files.sort();
        println!("machine: {}\nfiles:", machine());
        files.iter().for_each(|file| println!("  {}", paths::shown(file)));
        if self.write {
            for (text, marks) in [(decisions, DECISIONS), (summary, MARKS)] {
                if !text.is_empty() {
                    sections::renew(DOCUMENT, marks, &format!("{text}\nMeasured on {}.\n", machine()))?;
                }
            }
            copy_pictures(&files)?;
            println!("renewed: {DOCUMENT}, docs/figures");
        }
        Ok(())
    }
}

/// The time left, once it can be estimated.
fn left(seconds: f64, done: f64) -> String {
    if seconds < 2.0 || done < 0.01 {
        return String::new();
    }
    let left = seconds * (1.0 - done) / done;
    if left < 60.0 { format!(", {left:.0} s left") } else { format!(", {:.0} min left", (left / 60.0).ceil()) }
}

/// A CSV file of what was measured on this machine.
pub fn measured_here(columns: &str, comments: &[&str]) -> Result<CsvFile> {
    let machine = format!("machine: {}", machine());
    CsvFile::new(columns, &[&[machine.as_str()], comments].concat())
}

fn save(folder: &Path, name: &str, text: &str) -> Result<()> {
    fs::write(folder.join(name), text).with_context(|| format!("{} cannot be written", folder.join(name).display()))
}

fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).with_context(|| format!("{} cannot be read", folder.display()))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let known = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "png" || ending == "csv");
    Ok(paths.filter(known).collect())
}

fn copy_pictures(files: &[PathBuf]) -> Result<()> {
    let figures = paths::workspace().join("docs").join("figures");
    fs::create_dir_all(&figures).context("docs/figures cannot be made")?;
    for path in files.iter().filter(|path| path.extension().is_some_and(|ending| ending == "png")) {
        let name = path.file_name().unwrap_or_default();
        fs::copy(path, figures.join(name)).with_context(|| format!("{} cannot be copied", path.display()))?;
    }
    Ok(())
}

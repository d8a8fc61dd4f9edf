//! The command `study`: packages the FMU, simulates the study's two cases through fmpy, and compares the results with the study
//! and with theory. The reports of both cases come with them.

pub mod comparison;
pub mod evaluation;
pub mod published;
pub mod report;
pub mod theory;

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use bevel_differential::model::Parameters;
use clap::Args;

use crate::fmu::package;
use crate::gears::report::{self as page, Order};
use crate::gears::study::evaluation::{Results, SimulationRequest};
use crate::gears::study::theory::Theory;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script, sections};

/// The document with the whole comparison.
const DOCUMENT: &str = "docs/study.md";
/// The rows of it that README.md has too.
const EXCERPT: [&str; 5] = [
    "straight: left, deg/s",
    "turn: left, deg/s",
    "turn: right, deg/s",
    "T/r_p, all planets, outer, N",
    "straight: mesh frequency, Hz",
];
/// The scenes of its two cases.
const SCENES: [&str; 2] = ["study_straight", "study_turning"];
/// The lines between which both documents have their table.
const MARKS: [&str; 2] = ["<!-- study table begin -->", "<!-- study table end -->"];

/// Packages the FMU, simulates the study and compares the results with it (the default command)
#[derive(Args, Clone, Debug, Default)]
pub struct StudyCommand {
    /// Also write the comparison into README.md and docs/study.md, and renew the pictures
    #[arg(long)]
    pub readme: bool,
}

impl StudyCommand {
    /// Runs the study and prints the comparison.
    pub fn run(&self) -> Result<()> {
        run(self.readme)
    }
}

fn run(readme: bool) -> Result<()> {
    let progress = Progress::of_steps(expected());
    // Python first: what the user has to install should come out at once
    progress.step("looking for Python");
    let environment = Environment::ready(|what| progress.stage(what))?;
    progress.step("packaging the FMU");
    let fmu = package::package()?;
    let folder = paths::study();
    paths::create_folder(&folder)?;
    let theory = Theory::new(&Parameters::default());
    let results = simulate(&environment, &fmu, &folder, &SimulationRequest::new(&theory), &progress)?;
    let pages: Vec<Order> = SCENES
        .map(|scene| Order { scene: scene.into(), file: folder.join(format!("{scene}.html")), settings: Vec::new() })
        .into();
    progress.step("writing the reports");
    page::write(&environment, &fmu, &pages, false, &progress)?;
    progress.finish();
    let report = comparison::report(&theory, &results);
    let markdown = report.markdown();
    fs::write(folder.join("table.md"), &markdown).context("the table cannot be written")?;
    print!("{}", report.terminal());
    println!("\nFMU:     {}\nresults: {}", paths::shown(&fmu), paths::shown(&folder));
    println!("reports: {}", pages.iter().map(|page| paths::shown(&page.file)).collect::<Vec<_>>().join(", "));
    if readme {
        sections::renew(DOCUMENT, MARKS, &markdown)?;
        sections::renew("README.md", MARKS, &report.excerpt(&EXCERPT))?;
        copy_pictures(&folder)?;
        println!("renewed: README.md, docs/study.md, docs/figures");
    }
    Ok(())
}

/// Time that the steps take on a machine of two cores [s]: the Python environment, the FMU, the study, the reports.
fn expected() -> Vec<f64> {
    let environment = if Environment::is_ready() { 0.3 } else { 17.0 };
    vec![environment, 0.7, 3.5, 8.0]
}

/// Runs study.py in `folder` and reads what it found.
fn simulate(
    environment: &Environment,
    fmu: &Path,
    folder: &Path,
    order: &SimulationRequest,
    progress: &Progress,
) -> Result<Results> {
    fs::write(folder.join("order.json"), order.json()?).context("the order for study.py cannot be written")?;
    let study = paths::workspace().join("fmu-build").join("python").join("study.py");
    progress.step("simulating");
    script::run(environment, &study, &[fmu, folder], progress)?;
    let results = fs::read_to_string(folder.join("results.json")).context("study.py left no results")?;
    serde_json::from_str(&results).context("the results of study.py cannot be read")
}

fn copy_pictures(folder: &Path) -> Result<()> {
    let figures = paths::workspace().join("docs").join("figures");
    fs::create_dir_all(&figures).context("docs/figures cannot be made")?;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if let (Some("png"), Some(name)) = (path.extension().and_then(|e| e.to_str()), path.file_name()) {
            fs::copy(&path, figures.join(name)).with_context(|| format!("{} cannot be copied", path.display()))?;
        }
    }
    Ok(())
}

//! Command `study`: packages the FMU, and the Python package compares it with the study and with theory. The command
//! writes reports of both cases, and installs the program `bevel-differential` of this checkout in the Python
//! environment.

use std::fs;

use answers::text;
use anyhow::{Context, Result};
use clap::Args;

use crate::fmu::package;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script, sections};

/// Document with the complete comparison.
const DOCUMENT: &str = "docs/study.md";
/// Lines around the table in the document.
const MARKS: [&str; 2] = ["<!-- study table begin -->", "<!-- study table end -->"];

/// Packages the FMU, simulates the study and compares the results with it (the default command)
#[derive(Args, Clone, Debug, Default)]
pub struct StudyCommand {
    /// Also write the comparison into docs/study.md, and renew the pictures
    #[arg(long)]
    pub write: bool,
}

impl StudyCommand {
    /// Runs the study and prints the comparison.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::of_steps(expected());
        // Python first, so that a missing installation is reported immediately
        progress.step("looking for Python");
        let environment = Environment::ready(|what| progress.stage(what))?;
        progress.step("packaging the FMU");
        let (fmu, left_out) = package::packed()?;
        let folder = paths::study();
        paths::create_folder(&folder)?;
        progress.step("simulating");
        let mut study = environment.command();
        study
            .args(["-m", "bevel_differential", "study", "--progress", "lines", "--fmu"])
            .arg(&fmu)
            .arg("--out")
            .arg(text::shown(&folder));
        let output = script::follow(&mut study, "the study", &progress)?;
        progress.finish();
        print!("{output}");
        println!("FMU: {}", paths::shown(&fmu));
        left_out.iter().for_each(|remark| println!("{remark}"));
        let program = paths::shown(&environment.launcher(&fmu)?);
        println!("more: {program} --help, such as {program} accuracy torque_bias --within 1%");
        if self.write {
            let text = fs::read_to_string(folder.join("table.md")).context("table.md cannot be read")?;
            sections::renew(DOCUMENT, MARKS, &text)?;
            sections::copy_pictures(&folder)?;
            println!("renewed: docs/study.md, docs/figures");
        }
        Ok(())
    }
}

/// Expected time of the steps on a machine with two cores [s]: the Python environment, the FMU, the study with its
/// reports.
fn expected() -> Vec<f64> {
    let environment = if Environment::is_ready() { 0.3 } else { 17.0 };
    vec![environment, 0.7, 11.5]
}

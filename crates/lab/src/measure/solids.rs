//! What facets cost in accuracy and in time: solid teeth in the study's turn, compared with exact teeth.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use crate::tools::scripted::{Document, Script, arguments};
use fmu_build::fmu::package;
use fmu_build::tools::{paths, sections};

const DOCUMENT: Document = Document {
    file: "docs/cost.md",
    marks: ["<!-- solids:begin -->", "<!-- solids:end -->"],
    pictures: &["solids_convergence.png", "solids_cycle.png"],
};
/// The page about the study has the table of ripples, which the script writes into its folder.
const STUDY: &str = "docs/study.md";
const STUDY_MARKS: [&str; 2] = ["<!-- solids table begin -->", "<!-- solids table end -->"];

/// Measures how the number of facets of solid teeth affects accuracy and time
///
/// Fails if solids miss the mean force of exact teeth.
#[derive(Args, Clone, Debug)]
pub struct SolidsCommand {
    /// Only 4 to 32 facets over 0.1 s
    #[arg(long, conflicts_with = "write")]
    quick: bool,
    /// Also renew docs/cost.md, the table in docs/study.md and the figures
    #[arg(long)]
    write: bool,
    /// Folder for figures and CSV [default: target/solids]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl SolidsCommand {
    /// Measures, draws and prints the tables.
    pub fn run(&self) -> Result<()> {
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("solids"));
        let script = Script::own("solids.py", "measuring", Some(&folder));
        DOCUMENT.make(&script, self.write, |progress| {
            progress.stage("packaging the FMU");
            Ok(arguments([package::package()?, folder.clone()], self.quick))
        })?;
        if self.write {
            let table = fs::read_to_string(folder.join("study.md")).context("study.md cannot be read")?;
            sections::renew(STUDY, STUDY_MARKS, &table)?;
            println!("renewed: {STUDY}");
        }
        Ok(())
    }
}

//! Whether answers of the command `accuracy` can be trusted: random scenes whose chosen settings run in the packaged FMU, against
//! another method; and how long the answers for the shipped scenes take.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use crate::tools::scripted::{Document, Script, arguments};
use fmu_build::fmu::package;
use fmu_build::tools::paths;

const RANDOM: Document =
    Document { file: "docs/accuracy.md", marks: ["<!-- survey:begin -->", "<!-- survey:end -->"], pictures: &[] };
const SHIPPED: Document =
    Document { file: "docs/accuracy.md", marks: ["<!-- shipped:begin -->", "<!-- shipped:end -->"], pictures: &[] };

/// Checks answers of `accuracy` on random scenes, in the FMU, against another method
#[derive(Args, Clone, Debug)]
pub struct SurveyCommand {
    /// Number of scenes
    #[arg(long, default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..))]
    scenes: u64,
    /// Seed of the scenes
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Answer for the shipped scenes instead, all outputs of each to 1 %, and say how long that takes
    #[arg(long)]
    shipped: bool,
    /// Also renew the section in docs/accuracy.md
    #[arg(long)]
    write: bool,
    /// Folder for the cases and the table of all [default: target/survey]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl SurveyCommand {
    /// Answers all questions, runs the FMU, and prints the table of misses.
    pub fn run(&self) -> Result<()> {
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("survey"));
        let script = Script::own("survey.py", "answering", Some(&folder));
        if self.shipped {
            return SHIPPED.make(&script, self.write, |_| Ok(vec!["--shipped".into()]));
        }
        RANDOM.make(&script, self.write, |progress| {
            progress.stage("packaging the FMU");
            let fmu = package::package()?;
            if folder.exists() {
                fs::remove_dir_all(&folder).with_context(|| format!("{} cannot be emptied", paths::shown(&folder)))?;
            }
            let numbers = [self.scenes, self.seed].map(|number| PathBuf::from(number.to_string()));
            Ok(arguments([fmu, folder].into_iter().chain(numbers), false))
        })
    }
}

//! Changes of the source that no test notices: drawn by a seed from the rooms with the physics, built in at once, tried one by one.

use std::ffi::OsString;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;

use crate::tools::scripted::Document;
use crate::tools::{environments, places};

const DOCUMENT: Document =
    Document { file: "docs/mutants.md", marks: ["<!-- mutants:begin -->", "<!-- mutants:end -->"], pictures: &[] };

/// Changes the source in one place at a time and lists the changes that no test notices (goes on where it was stopped)
#[derive(Args, Clone, Debug)]
pub struct MutantsCommand {
    /// How many changes
    #[arg(long, default_value_t = 120)]
    count: usize,
    /// By which they are drawn
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Also renew the report in docs/mutants.md
    #[arg(long)]
    write: bool,
}

impl MutantsCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let environment = environments::parser(|what| progress.stage(what))?;
        let folder: PathBuf = paths::target().join("mutants").join(format!("{}-{}", self.seed, self.count));
        let numbers = [self.count as u64, self.seed].map(|number| OsString::from(number.to_string()));
        let arguments: Vec<OsString> =
            [paths::workspace().into(), folder.clone().into()].into_iter().chain(numbers).collect();
        let script = places::script("mutants").join("campaign.py");
        DOCUMENT.make(progress, "trying changes", (&environment, &script, &arguments), &folder, self.write)
    }
}

//! Changes of the source that no test notices: drawn by a seed from the rooms with the physics, built in at once, tried one by one.

use anyhow::Result;
use clap::Args;
use fmu_build::tools::paths;

use crate::tools::places;
use crate::tools::scripted::{Document, Script, arguments};

const DOCUMENT: Document =
    Document { file: "docs/architecture.md", marks: ["<!-- mutants:begin -->", "<!-- mutants:end -->"], pictures: &[] };

/// Changes the source in one place at a time and lists the changes that no test notices (goes on where it was stopped)
#[derive(Args, Clone, Debug)]
pub struct MutantsCommand {
    /// How many changes
    #[arg(long, default_value_t = 120)]
    count: usize,
    /// By which they are drawn
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Also renew the report in docs/architecture.md
    #[arg(long)]
    write: bool,
}

impl MutantsCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        let folder = paths::target().join("mutants").join(format!("{}-{}", self.seed, self.count));
        let script =
            Script::of(&places::MUTANTS, places::MUTANTS.folder().join("campaign.py"), "trying changes", &folder);
        let numbers = [self.count as u64, self.seed].map(|number| number.to_string().into());
        DOCUMENT.make(&script, self.write, |_| {
            Ok(arguments([paths::workspace(), folder].into_iter().chain(numbers), false))
        })
    }
}

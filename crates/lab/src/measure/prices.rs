//! What levels, laws and effects cost in time: each alone, each pair, all together; or how the times of two builds compare.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::tools::scripted::{Document, Script, arguments};
use fmu_build::fmu::package;
use fmu_build::tools::paths;

const DOCUMENT: Document =
    Document { file: "docs/cost.md", marks: ["<!-- prices:begin -->", "<!-- prices:end -->"], pictures: &[] };
/// Prices of each alone, by which the command `accuracy` counts and the page shows.
const DATA: &str = "prices.csv";
/// Runs of each, and for a quick look.
const RUNS: u32 = 9;
const FEW: u32 = 3;

/// Times what each level, law and effect costs, or the FMUs of two builds (an idle machine, some minutes)
#[derive(Args, Clone, Debug)]
pub struct PricesCommand {
    /// The FMU of another build: prints the ratios of this build's times to its own
    #[arg(long, value_name = "FMU", conflicts_with = "write")]
    against: Option<PathBuf>,
    /// Three runs of each instead of nine, and no pairs
    #[arg(long, conflicts_with = "write")]
    quick: bool,
    /// Also renew the tables in docs/cost.md and the prices by which `accuracy` counts
    #[arg(long)]
    write: bool,
}

impl PricesCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        if let Some(other) = &self.against {
            ensure!(other.is_file(), "{}: there is no such FMU", other.display());
        }
        let folder = paths::target().join("prices");
        let script = Script::own("prices.py", "timing", Some(&folder));
        DOCUMENT.make(&script, self.write, |progress| {
            progress.stage("packaging the FMU");
            let mut given = arguments([package::package()?, folder.clone()], false);
            given.push(if self.quick { FEW } else { RUNS }.to_string().into());
            given.push(if self.quick { "alone" } else { "pairs" }.into());
            given.extend(self.against.iter().map(Into::into));
            Ok(given)
        })?;
        if self.write {
            let data = paths::workspace().join("crates").join("answers").join("data").join(DATA);
            fs::copy(folder.join(DATA), &data).with_context(|| format!("{} cannot be written", paths::shown(&data)))?;
            println!("renewed: {}", paths::shown(&data));
        }
        Ok(())
    }
}

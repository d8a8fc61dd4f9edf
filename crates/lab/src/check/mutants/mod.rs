//! Changes of the source that no test notices, found by cargo-mutants in the rooms with the physics.

mod outcomes;
mod report;
mod tool;

use anyhow::Result;
use clap::Args;

use answers::text::table::for_terminal;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::sections;

/// The page with the report, and the marks around it.
const PAGE: &str = "docs/mutants.md";
const MARKS: [&str; 2] = ["<!-- mutants:begin -->", "<!-- mutants:end -->"];

/// Changes the source in one place at a time and lists the changes that no test notices (hours; a sample by default)
#[derive(Args, Clone, Debug)]
pub struct MutantsCommand {
    /// Part K of N of all changes: every N-th of them, from the K-th on
    #[arg(long, value_name = "K/N", default_value = "0/60")]
    shard: String,
    /// Only files whose path matches this pattern, instead of all rooms with the physics
    #[arg(long, value_name = "GLOB")]
    file: Vec<String>,
    /// Run nothing: report the last run again, with explanations added since
    #[arg(long)]
    last: bool,
    /// Also renew the report in docs/mutants.md
    #[arg(long)]
    write: bool,
}

impl MutantsCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        if !self.last {
            let progress = Progress::start("looking for cargo-mutants");
            let tool = tool::installed(&progress)?;
            progress.finish();
            tool::run(&tool, &self.shard, &self.file)?;
        }
        let run = outcomes::read(&tool::results())?;
        let page = report::page(&run, &report::explanations()?);
        println!("{}", for_terminal(&page));
        if self.write {
            sections::renew(PAGE, MARKS, &page)?;
        }
        Ok(())
    }
}

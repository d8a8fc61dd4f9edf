//! What counts instructions by valgrind: effects that are off, and the steps of the fixed-step method.

use anyhow::Result;
use bevel_differential::model::EFFECTS;
use clap::Args;

use crate::tools::scripted::{Document, Script};
use fmu_build::tools::paths;

const EFFECTS_PAGE: Document =
    Document { file: "docs/effects.md", marks: ["<!-- off:begin -->", "<!-- off:end -->"], pictures: &[] };
const COST_PAGE: Document =
    Document { file: "docs/cost.md", marks: ["<!-- real-time:begin -->", "<!-- real-time:end -->"], pictures: &[] };
/// The folder in which both build the program that steps.
const BUILD: &str = "off";

/// Checks that effects that are off cost nothing, by bits and instructions of a build without any (needs valgrind)
#[derive(Args, Clone, Debug)]
pub struct ZeroCostCommand {
    /// Leave out what each effect costs when it is on
    #[arg(long)]
    quick: bool,
    /// Also renew the table in docs/effects.md
    #[arg(long)]
    write: bool,
}

/// Checks that no step of the fixed-step method costs more than twice the median, in instructions (needs valgrind)
#[derive(Args, Clone, Debug)]
pub struct RealTimeCommand {
    /// Also renew the table in docs/cost.md
    #[arg(long)]
    write: bool,
}

impl ZeroCostCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        EFFECTS_PAGE.make(&Script::own("zero_cost.py", "counting", None), self.write && !self.quick, |_| {
            let on = EFFECTS.iter().filter(|_| !self.quick).map(|effect| effect.name.into());
            Ok([paths::target().join(BUILD).into()].into_iter().chain(on).collect())
        })
    }
}

impl RealTimeCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        COST_PAGE.make(&Script::own("real_time.py", "counting", None), self.write, |_| {
            Ok(["real-time", BUILD].map(|folder| paths::target().join(folder).into()).to_vec())
        })
    }
}

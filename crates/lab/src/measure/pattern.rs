//! The contact patterns of the documentation, by the command `pattern` of the Python package.

use std::fs;

use anyhow::{Context, Result};
use clap::Args;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use fmu_build::tools::{paths, script};

use crate::tools::scripted::Document;

const DOCUMENT: Document = Document {
    file: "docs/geometry.md",
    marks: ["<!-- pattern:begin -->", "<!-- pattern:end -->"],
    pictures: &["contact_pattern.png", "contact_lines.png"],
};

/// Shows the contact patterns of docs/geometry.md: aligned teeth, and one thing out of place at a time
#[derive(Args, Clone, Debug)]
pub struct PatternsCommand {
    /// Also renew docs/geometry.md and its figures
    #[arg(long)]
    write: bool,
}

impl PatternsCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let environment = Environment::ready(|what| progress.stage(what))?;
        let folder = paths::target().join("pattern");
        progress.begin_bar("simulating");
        let mut command = environment.command();
        command.args(["-m", "bevel_differential", "pattern", "--progress", "lines", "--out"]).arg(&folder);
        let told = script::follow(&mut command, "the command pattern", &progress)?;
        progress.finish();
        print!("{told}");
        if self.write {
            let findings = fs::read_to_string(folder.join("findings.md")).context("findings.md cannot be read")?;
            DOCUMENT.renew(&findings, Some(&folder))?;
        }
        Ok(())
    }
}

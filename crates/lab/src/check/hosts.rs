//! The packaged FMU in other hosts: each host on each scene, all compared with fmpy; one table.

use anyhow::Result;
use clap::Args;

use crate::tools::places;
use crate::tools::scripted::{Document, Script, arguments};
use fmu_build::fmu::{package, plain_types};
use fmu_build::tools::paths;

const DOCUMENT: Document =
    Document { file: "docs/fmi.md", marks: ["<!-- hosts:begin -->", "<!-- hosts:end -->"], pictures: &[] };

/// Runs the FMU in other FMI hosts on the same scenes and compares their results with fmpy's
#[derive(Args, Clone, Copy, Debug)]
pub struct HostsCommand {
    /// Fail if a host cannot be loaded
    #[arg(long)]
    require: bool,
    /// Also renew docs/fmi.md
    #[arg(long)]
    write: bool,
    /// Also run hosts in Rust: fmi-sim, fmi-rs and fmu-runner (builds for many minutes)
    #[arg(long = "with-fmi-sim")]
    with_rust: bool,
}

impl HostsCommand {
    /// Runs it.
    pub fn run(self) -> Result<()> {
        let folder = paths::target().join("hosts");
        let script = Script::of(&places::HOSTS, places::script("hosts.py"), "running hosts", &folder);
        DOCUMENT.make(&script, self.write, |progress| {
            progress.stage("packaging the FMU");
            let fmu = package::package()?;
            let plain = plain_types::package(&fmu)?;
            let mut given = arguments([fmu, plain, folder], false);
            given.extend(self.require.then(|| "--require".into()));
            given.extend(self.with_rust.then(|| "--with-rust".into()));
            Ok(given)
        })
    }
}

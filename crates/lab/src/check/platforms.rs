//! The same scenes with the library for each platform, Windows under wine: the bits of all outputs, and the time.

use std::ffi::OsString;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::tools::places;
use crate::tools::scripted::{Document, Needs, Script};
use fmu_build::fmu::libraries::{self, Library};
use fmu_build::fmu::package::{self, Packing};
use fmu_build::fmu::toolchains::{self, WINDOWS};
use fmu_build::tools::paths;

const DOCUMENT: Document =
    Document { file: "docs/fmi.md", marks: ["<!-- platforms:begin -->", "<!-- platforms:end -->"], pictures: &[] };

/// Checks that the libraries of all platforms give the same bits, Windows under wine
#[derive(Args, Clone, Debug)]
pub struct PlatformsCommand {
    /// Also renew docs/fmi.md
    #[arg(long)]
    write: bool,
}

impl PlatformsCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        let script =
            Script { file: places::script("platforms.py"), doing: "comparing", needs: Needs::Tests, folder: None };
        DOCUMENT
            .make(&script, self.write, |progress| {
                progress.stage("building the library for each platform");
                built()
            })
            .context("the libraries do not agree, or could not be compared")
    }
}

/// An FMU for each library: the arguments of the script.
fn built() -> Result<Vec<OsString>> {
    let (Some(_), Some(windows)) = (toolchains::old_linux().found(), WINDOWS.found()) else {
        bail!("the tool chains for other machines are not installed; to get them: {}", toolchains::COMMAND);
    };
    let own = libraries::for_this_machine()?;
    let mut named: Vec<(String, Library)> =
        vec![("linux64, plain".into(), own.clone()), ("linux64, narrow".into(), own)];
    let crossed = libraries::build()?.built;
    named.extend(crossed.into_iter().map(|library| {
        let what = if library.platform == "win64" { "wine".into() } else { format!("glibc {}", toolchains::GLIBC) };
        (format!("{}, {what}", library.platform), library)
    }));
    let mut arguments: Vec<OsString> = vec![paths::scenes().into(), windows.programs().join("wine64").into()];
    for (index, (name, library)) in named.into_iter().enumerate() {
        let fmu = paths::target().join("platforms").join(format!("{index}.fmu"));
        package::write_archive(&[library], None, Packing::Quick, &fmu)?;
        let mut pair = OsString::from(format!("{name}="));
        pair.push(fmu);
        arguments.push(pair);
    }
    Ok(arguments)
}

//! The same scenes with the library for each platform, Windows under wine: the bits of all outputs, and the time.

use std::ffi::OsString;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::tools::places;
use answers::text::table::for_terminal;
use fmu_build::fmu::libraries::{self, Library};
use fmu_build::fmu::package::{self, Packing};
use fmu_build::fmu::toolchains::{self, WINDOWS};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use fmu_build::tools::{paths, script, sections};

/// The document with the tables, and their place.
const DOCUMENT: &str = "docs/platforms.md";
const MARKS: [&str; 2] = ["<!-- platforms:begin -->", "<!-- platforms:end -->"];

/// Checks that the libraries of all platforms give the same bits, Windows under wine
#[derive(Args, Clone, Debug)]
pub struct PlatformsCommand {
    /// Also renew docs/platforms.md
    #[arg(long)]
    write: bool,
}

impl PlatformsCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        run(self.write)
    }
}

fn run(write: bool) -> Result<()> {
    let progress = Progress::start("looking for Python");
    let environment = Environment::complete(|what| progress.stage(what))?;
    let (Some(_), Some(windows)) = (toolchains::old_linux().found(), WINDOWS.found()) else {
        bail!("the tool chains for other machines are not installed; to get them: {}", toolchains::COMMAND);
    };
    progress.stage("building the library for each platform");
    let own = libraries::for_this_machine()?;
    let mut named: Vec<(String, Library)> =
        vec![("linux64, plain".into(), own.clone()), ("linux64, vectors narrow".into(), own)];
    let crossed = libraries::build()?.built;
    named.extend(crossed.into_iter().map(|library| {
        let what = if library.platform == "win64" { "wine".into() } else { format!("glibc {}", toolchains::GLIBC) };
        (format!("{}, {what}", library.platform), library)
    }));
    let wine = windows.programs().join("wine64");
    let mut arguments: Vec<OsString> = vec![paths::scenes().into(), wine.into()];
    for (index, (name, library)) in named.into_iter().enumerate() {
        let fmu = paths::target().join("platforms").join(format!("{index}.fmu"));
        package::write_archive(&[library], None, Packing::Quick, &fmu)?;
        let mut pair = OsString::from(format!("{name}="));
        pair.push(fmu);
        arguments.push(pair);
    }
    progress.begin_bar("comparing");
    let program = places::script("platforms.py");
    let tables = script::run(&environment, &program, &arguments, &progress)
        .context("the libraries do not agree, or could not be compared")?;
    progress.finish();
    print!("{}", for_terminal(&tables));
    if write {
        sections::renew(DOCUMENT, MARKS, &tables)?;
        println!("\nrenewed: {DOCUMENT}");
    }
    Ok(())
}

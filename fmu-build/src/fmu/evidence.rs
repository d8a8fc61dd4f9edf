//! Evidence in the FMU: start values, inputs, results and tolerances of scenes, as data in the repository. A script
//! makes them; packaging copies them.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use clap::Args;

use crate::fmu::package;
use crate::tools::files::remove_folder;
use crate::tools::lock::Lock;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script};

/// The folder in the archive. FMI-LS-REF gives its name.
const IN_ARCHIVE: &str = "extra/org.fmi-standard.fmi-ls-ref";
/// Document that states how to test with the evidence. FMI-LS-REF recommends its name, in the FMU's folder of documentation.
pub const DOCUMENT: &str = "fmi-ls-ref.txt";
/// The script that makes the files.
const SCRIPT: &str = "fmu-build/python/evidence.py";
/// Scenes only for the evidence, with the laws, levels of gear contact and effects that no shipped scene uses.
const SCENES: &str = "fmu-build/evidence";

/// Simulates the shipped scenes and those of fmu-build/evidence, and writes their results to modelDescription/evidence, for `bevel-differential verify`
#[derive(Args, Clone, Debug)]
pub struct EvidenceCommand {}

impl EvidenceCommand {
    /// Writes the files and prints the script's summary.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let environment = Environment::ready(|what| progress.stage(what))?;
        progress.stage("packaging the FMU");
        let fmu = package::package()?;
        progress.begin_bar("simulating");
        let _alone = Lock::of(&paths::target().join("evidence"))?;
        let made = paths::evidence().with_file_name(".evidence.part");
        let mut command = environment.command();
        command.arg(paths::workspace().join(SCRIPT)).arg(&fmu).arg(paths::workspace().join(SCENES)).arg(&made);
        let output = script::follow(&mut command, SCRIPT, &progress)?;
        take(&made)?;
        progress.finish();
        print!("{output}");
        println!("{} is renewed; the next packaging takes it into the FMU", paths::shown(&paths::evidence()));
        Ok(())
    }
}

/// The lock of the evidence in the repository, held while it is replaced or read.
fn lock() -> Result<Lock> {
    Lock::of(&paths::target().join("evidence-files"))
}

/// Puts the folder `made` in the place of the evidence in the repository.
fn take(made: &Path) -> Result<()> {
    let (_alone, old) = (lock()?, paths::evidence());
    remove_folder(&old)?;
    fs::rename(made, &old).with_context(|| format!("{} cannot be written", paths::shown(&old)))
}

/// Paths in the archive and contents, in a fixed order. Empty without the folder, because the FMU that makes the first evidence has none.
pub fn files() -> Result<Vec<(String, Vec<u8>)>> {
    let (_alone, root) = (lock()?, paths::evidence());
    let mut found = Vec::new();
    if root.is_dir() {
        collect(&root, IN_ARCHIVE, &mut found)?;
    }
    found.sort();
    Ok(found)
}

fn collect(folder: &Path, in_archive: &str, found: &mut Vec<(String, Vec<u8>)>) -> Result<()> {
    for entry in fs::read_dir(folder).with_context(|| format!("{} cannot be read", paths::shown(folder)))? {
        let entry = entry?.path();
        let name = entry.file_name().unwrap_or_default().to_string_lossy();
        let folder = if name == DOCUMENT { "documentation" } else { in_archive };
        let name = format!("{folder}/{name}");
        if entry.is_dir() {
            collect(&entry, &name, found)?;
        } else {
            found.push((name, fs::read(&entry).with_context(|| format!("{} cannot be read", paths::shown(&entry)))?));
        }
    }
    Ok(())
}

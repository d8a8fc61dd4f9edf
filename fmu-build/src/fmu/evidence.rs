//! Evidence in the FMU: start values, inputs, results and tolerances of scenes, as files in the repository. The command
//! `evidence` creates them, and packaging copies them.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::tools::files::remove_folder;
use crate::tools::lock::Lock;
use crate::tools::paths;

/// Folder in the archive, with the name from FMI-LS-REF.
const IN_ARCHIVE: &str = "extra/org.fmi-standard.fmi-ls-ref";
/// Instructions for testing with the evidence. FMI-LS-REF recommends this name, in the FMU's folder of documentation.
pub const DOCUMENT: &str = "fmi-ls-ref.txt";

/// Locks the evidence in the repository while it is replaced or read.
fn lock() -> Result<Lock> {
    Lock::of(&paths::target().join("evidence-files"))
}

/// Replaces the evidence in the repository by the folder `made`.
pub fn take(made: &Path) -> Result<()> {
    let (_alone, old) = (lock()?, paths::evidence());
    remove_folder(&old)?;
    fs::rename(made, &old).with_context(|| format!("{} cannot be written", paths::shown(&old)))
}

/// Paths in the archive with contents, in a fixed order. Empty if the folder is missing, because the FMU that creates
/// the first evidence has none.
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

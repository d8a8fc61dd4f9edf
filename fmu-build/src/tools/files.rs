//! Files that builds write and copy, none where the sources are.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::tools::paths;

/// Copies all files below `from` to `to`, but for folders called `without`.
pub fn copy_folder(from: &Path, to: &Path, without: &str) -> Result<()> {
    for entry in fs::read_dir(from).with_context(|| format!("{} cannot be read", paths::shown(from)))? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default();
        if path.is_file() {
            copy_file(&path, to)?;
        } else if name != without {
            copy_folder(&path, &to.join(name), without)?;
        }
    }
    Ok(())
}

/// Writes a file that is complete or not there, as others may write it at the same time.
pub fn write_whole(file: &Path, content: &[u8]) -> Result<()> {
    paths::create_folder(file.parent().unwrap_or(Path::new(".")))?;
    let partial = file.with_extension(format!("{}.part", std::process::id()));
    let written = fs::write(&partial, content).and_then(|()| fs::rename(&partial, file));
    written.with_context(|| format!("{} cannot be written", paths::shown(file)))
}

/// Copies a file into a folder, which is made.
pub fn copy_file(file: &Path, folder: &Path) -> Result<()> {
    paths::create_folder(folder)?;
    let target = folder.join(file.file_name().unwrap_or_default());
    fs::copy(file, target).with_context(|| format!("{} cannot be copied", paths::shown(file))).map(drop)
}

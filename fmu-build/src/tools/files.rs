//! Files that builds write and copy, always outside the sources' folders.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use answers::text::whole_file;

use crate::tools::paths;

/// Copies all files below `from` to `to`, except folders named `without`.
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

/// Writes a file that is either complete or missing, even if other processes write it at the same time.
pub fn write_whole(file: &Path, content: &[u8]) -> Result<()> {
    make_whole(file, |part| {
        fs::write(part, content).with_context(|| format!("{} cannot be written", paths::shown(file)))
    })
}

/// Calls `make` to write a file to the path that it receives. The file is either complete or missing.
pub fn make_whole(file: &Path, make: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
    paths::create_folder(file.parent().unwrap_or(Path::new(".")))?;
    whole_file::write(file, make)
}

/// Removes a folder with its contents, if it exists.
pub fn remove_folder(folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| format!("{} cannot be removed", paths::shown(folder)))?;
    }
    Ok(())
}

/// Copies a file into a folder, which is created if necessary.
pub fn copy_file(file: &Path, folder: &Path) -> Result<()> {
    paths::create_folder(folder)?;
    let target = folder.join(file.file_name().unwrap_or_default());
    make_whole(&target, |part| {
        fs::copy(file, part).with_context(|| format!("{} cannot be copied", paths::shown(file))).map(drop)
    })
}

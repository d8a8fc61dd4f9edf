//! Folders and files of the workspace and of the target directory.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// Root of the workspace. It is known at compile time, because this program belongs to its workspace.
pub fn workspace() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_path_buf()
}

/// Target directory that contains the running executable, recognised by cargo's tag file.
pub fn target() -> PathBuf {
    let built_into = env::current_exe().ok().and_then(|exe| {
        let tagged = exe.ancestors().find(|folder| folder.join("CACHEDIR.TAG").is_file());
        tagged.map(Path::to_path_buf)
    });
    built_into
        .or_else(|| env::var_os("CARGO_TARGET_DIR").map(|folder| workspace().join(folder)))
        .unwrap_or_else(|| workspace().join("target"))
}

/// Path of the dynamic library of a crate that cargo built together with this program.
pub fn built(package: &str) -> Result<PathBuf> {
    let program = env::current_exe().context("the path of this program is unknown")?;
    let beside = program.parent().context("the folder of this program is unknown")?;
    // programs of tests are in the folder of their dependencies
    let deps = if beside.ends_with("deps") { beside.to_path_buf() } else { beside.join("deps") };
    Ok(deps.join([env::consts::DLL_PREFIX, &package.replace('-', "_"), env::consts::DLL_SUFFIX].concat()))
}

/// Creates `folder` and its parents unless they exist.
pub fn create_folder(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("{} cannot be created", shown(folder)))
}

/// Path of the packaged FMU.
pub fn fmu() -> PathBuf {
    target().join("fmu").join(format!("{}.fmu", bevel_differential::variables::MODEL_NAME))
}

/// Folder of the page for browsers and its bundled sources.
pub fn page() -> PathBuf {
    target().join("page")
}

/// Folder of the Python package as a wheel, and of its tests.
pub fn wheel() -> PathBuf {
    target().join("wheel")
}

/// Folder of the tool chains for other machines.
pub fn toolchains() -> PathBuf {
    target().join("toolchains")
}

/// Folder of the study's results.
pub fn study() -> PathBuf {
    target().join("study")
}

/// Folder of the scenes in the repository.
pub fn scenes() -> PathBuf {
    workspace().join("scenes")
}

/// Path of the model description in the repository.
pub fn model_description() -> PathBuf {
    workspace().join("modelDescription").join("modelDescription.xml")
}

/// Folder of the evidence in the repository, which the FMU contains.
pub fn evidence() -> PathBuf {
    workspace().join("modelDescription").join("evidence")
}

/// Returns `path` relative to the current folder or to the workspace, for messages.
pub fn shown(path: &Path) -> String {
    let from = env::current_dir().unwrap_or_else(|_| workspace());
    path.strip_prefix(&from).or_else(|_| path.strip_prefix(workspace())).unwrap_or(path).display().to_string()
}

//! Where things lie in the workspace and in the target directory.

use std::env;
use std::path::{Path, PathBuf};

/// Root of the workspace. The tool belongs to its workspace, so the place known at compile time will do.
pub fn workspace() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_path_buf()
}

/// The target directory that the running executable was built into; a tag file by cargo marks it.
pub fn target() -> PathBuf {
    let built_into = env::current_exe().ok().and_then(|exe| {
        let tagged = exe.ancestors().find(|folder| folder.join("CACHEDIR.TAG").is_file());
        tagged.map(Path::to_path_buf)
    });
    built_into
        .or_else(|| env::var_os("CARGO_TARGET_DIR").map(|folder| workspace().join(folder)))
        .unwrap_or_else(|| workspace().join("target"))
}

/// The packaged FMU.
pub fn fmu() -> PathBuf {
    target().join("fmu").join(format!("{}.fmu", bevel_differential::variables::MODEL_NAME))
}

/// The tool chains for machines other than this one.
pub fn toolchains() -> PathBuf {
    target().join("toolchains")
}

/// Results of the study.
pub fn study() -> PathBuf {
    target().join("study")
}

/// The comparison with other programs.
pub fn peers() -> PathBuf {
    workspace().join("benches").join("peers")
}

/// The comparison with solvers written by others.
pub fn foreign() -> PathBuf {
    workspace().join("benches").join("foreign")
}

/// The scripts and scenes of other hosts.
pub fn hosts() -> PathBuf {
    workspace().join("tests").join("hosts")
}

/// The drivetrain coupled from FMUs.
pub fn drivetrain() -> PathBuf {
    workspace().join("examples").join("drivetrain")
}

/// Hosts written in C.
pub fn c_hosts() -> PathBuf {
    workspace().join("tests").join("c")
}

/// The scenes kept in the repository.
pub fn scenes() -> PathBuf {
    workspace().join("scenes")
}

/// The model description kept in the repository.
pub fn model_description() -> PathBuf {
    workspace().join("modelDescription").join("modelDescription.xml")
}

/// `path` as a reader standing in the workspace would write it.
pub fn shown(path: &Path) -> String {
    let from = env::current_dir().unwrap_or_else(|_| workspace());
    path.strip_prefix(&from).or_else(|_| path.strip_prefix(workspace())).unwrap_or(path).display().to_string()
}

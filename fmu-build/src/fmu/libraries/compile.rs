//! Compilation of libraries by cargo, without folder names of this machine in them.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use super::library::CRATES;
use crate::tools::paths;

/// Builds the libraries of [`CRATES`] with `options` of the compiler, without paths of this machine. The target folder
/// is separate, because the options always differ and the compiler may differ.
pub(super) fn distributable(mut command: Command, name: &str, ending: &str, options: &[&str]) -> Result<[PathBuf; 2]> {
    let options: Vec<String> =
        without_folders().into_iter().chain(options.iter().map(|&option| option.into())).collect();
    command
        .arg("--target-dir")
        .arg(paths::target().join("cross").join(name))
        // independent of the other builds: with one unit, the important functions are inlined
        .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "1")
        .env("CARGO_ENCODED_RUSTFLAGS", options.join("\u{1f}"));
    built_by(command, ending).with_context(|| format!("the library for {name}"))
}

/// Options that replace the folders of this machine in the locations of panics.
pub(in crate::fmu) fn without_folders() -> Vec<String> {
    // if several match, the last one applies
    let folders = folders().into_iter().rev();
    folders.map(|(folder, name)| format!("--remap-path-prefix={}={name}", folder.display())).collect()
}

/// Folders of this machine that compilers write into libraries, with their replacements; the longest first.
pub(super) fn folders() -> Vec<(PathBuf, &'static str)> {
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| env::home_dir().map(|home| home.join(".cargo")));
    let folders = [
        (Some(paths::workspace()), "."),
        (Some(paths::target()), "target"),
        (Some(paths::toolchains()), "toolchains"),
        (home.clone(), "cargo"),
        (home.map(|home| home.join("registry").join("src")), "crates"),
    ];
    let mut known: Vec<_> = folders.into_iter().filter_map(|(folder, name)| Some((folder?, name))).collect();
    known.sort_by_key(|(folder, _)| std::cmp::Reverse(folder.as_os_str().len()));
    known
}

/// Runs `command`, cargo with a target, and returns the libraries of [`CRATES`]. One run compiles shared crates only once.
fn built_by(mut command: Command, ending: &str) -> Result<[PathBuf; 2]> {
    let output = command
        .current_dir(paths::workspace())
        .args(["--release", "--lib", "--quiet", "--message-format", "json-render-diagnostics"])
        .args(CRATES.iter().flat_map(|package| ["-p", package]))
        .output()
        .with_context(|| format!("{} cannot be run", command.get_program().display()))?;
    if !output.status.success() {
        bail!("the library does not build:\n{}", String::from_utf8_lossy(&output.stderr).trim_end());
    }
    let artifacts = String::from_utf8_lossy(&output.stdout);
    let built = CRATES.map(|package| {
        let crate_name = package.replace('-', "_");
        artifacts.lines().filter_map(|line| library_in(line, &crate_name, ending)).next_back()
    });
    let complete: Option<Vec<PathBuf>> = built.into_iter().collect();
    complete.and_then(|built| built.try_into().ok()).with_context(|| format!("cargo built no .{ending} file"))
}

/// Returns the dynamic library of a crate if one line of cargo's messages names it.
fn library_in(line: &str, crate_name: &str, ending: &str) -> Option<PathBuf> {
    let message: serde_json::Value = serde_json::from_str(line).ok()?;
    let is_cdylib = message["target"]["kind"].as_array()?.iter().any(|kind| kind == "cdylib");
    let files = message["filenames"].as_array()?.iter().filter_map(|name| name.as_str()).map(Path::new);
    let mut libraries = files.filter(|file| file.extension().is_some_and(|found| found == ending));
    let is_meant = is_cdylib && message["target"]["name"] == crate_name;
    if is_meant { libraries.next().map(Path::to_path_buf) } else { None }
}

/// Cargo that runs this program, or the one in PATH.
pub fn cargo() -> std::ffi::OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

//! The program that makes the changes: cargo-mutants, installed into the target directory, and how it is run.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};

use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;

/// The version that reports were made with.
const VERSION: &str = "27.1.0";
/// Rooms with the physics.
const ROOMS: [&str; 4] =
    ["src/contact/**/*.rs", "src/model/dynamics/**/*.rs", "src/strength/**/*.rs", "src/friction/**/*.rs"];
/// Exit codes of a completed run: all noticed, some not, some without an end.
const COMPLETED: [i32; 3] = [0, 2, 3];
/// The file beside the results that names the shard.
pub const SAMPLE: &str = "shard.txt";
/// A build per change: quick to build, and again after a change, is worth more than quick to run.
const PROFILE: [(&str, &str); 4] = [
    ("CARGO_PROFILE_DEV_OPT_LEVEL", "1"),
    ("CARGO_PROFILE_DEV_DEBUG", "0"),
    ("CARGO_PROFILE_DEV_INCREMENTAL", "true"),
    ("CARGO_PROFILE_DEV_CODEGEN_UNITS", "256"),
];

/// Where results are.
pub fn results() -> PathBuf {
    paths::target().join("mutants").join("mutants.out")
}

/// The program, installed if it is not there in this version.
pub fn installed(progress: &Progress) -> Result<PathBuf> {
    let root = paths::target().join("tools");
    let program = root.join("bin").join(format!("cargo-mutants{}", std::env::consts::EXE_SUFFIX));
    let version = Command::new(&program).args(["mutants", "--version"]).output();
    if version.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).trim().ends_with(VERSION)) {
        return Ok(program);
    }
    progress.stage("installing cargo-mutants (a few minutes)");
    let output = Command::new(env!("CARGO"))
        .args(["install", "cargo-mutants", "--locked", "--quiet", "--version", VERSION, "--root"])
        .arg(&root)
        .output()
        .context("cargo did not start")?;
    let said = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "cargo-mutants cannot be installed (check the network):\n{}", said.trim_end());
    Ok(program)
}

/// Changes a copy of the workspace, part `shard` of all changes in `files`, or in the rooms with the physics, and lets the
/// tests of the library run on each.
pub fn run(program: &Path, shard: &str, files: &[String]) -> Result<()> {
    let rooms = ROOMS.map(str::to_owned);
    let output = paths::target().join("mutants");
    paths::create_folder(&output)?;
    let mut command = Command::new(program);
    command.arg("mutants").current_dir(paths::workspace()).arg("--output").arg(&output);
    for file in if files.is_empty() { &rooms[..] } else { files } {
        command.args(["--file", file]);
    }
    // its own progress, as it knows it; tests of the library and of the C interface, in the order of the file names
    let status = command
        .args(["--package", "bevel-differential", "--shard", shard, "--sharding", "round-robin", "--no-shuffle"])
        .args(["--", "--lib", "--tests"])
        .envs(PROFILE)
        .status()
        .context("cargo-mutants did not start")?;
    match status.code() {
        Some(code) if COMPLETED.contains(&code) => {
            let sample = results().join(SAMPLE);
            fs::write(&sample, shard).with_context(|| format!("{} cannot be written", paths::shown(&sample)))
        }
        _ => bail!("cargo-mutants stopped ({status}): see {}", paths::shown(&results())),
    }
}

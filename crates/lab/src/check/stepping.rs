//! The program that takes communication steps and nothing else, and the instructions it executes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use bevel_differential::numeric::lanes;

use fmu_build::tools::paths;

/// Builds the stepping program, with or without effects, and returns a copy of it named `name`.
pub fn build(effects: bool, name: &str) -> Result<PathBuf> {
    let target = paths::target().join("off");
    let output = Command::new(env!("CARGO"))
        .current_dir(paths::workspace())
        .args(["build", "--package", "bevel-differential", "--bench", "steps", "--profile", "bench", "--quiet"])
        .args((!effects).then_some("--no-default-features"))
        .args(["--message-format", "json"])
        .arg("--target-dir")
        .arg(&target)
        // as the FMU's library, whatever the rest is built with, and with the names of functions for callgrind
        .envs(["BENCH", "RELEASE"].map(|profile| (format!("CARGO_PROFILE_{profile}_CODEGEN_UNITS"), "1")))
        .env("CARGO_PROFILE_BENCH_STRIP", "debuginfo")
        .output()
        .context("cargo did not start")?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let executable = String::from_utf8_lossy(&output.stdout)
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok())
        .filter(|message| message["target"]["name"] == "steps")
        .find_map(|message| message["executable"].as_str().map(PathBuf::from))
        .context("cargo named no executable")?;
    // the next build takes the place of this one; names are of one length, as they move the stack and with it what
    // filling memory costs
    let copy = target.join(name);
    fs::copy(executable, &copy)?;
    Ok(copy)
}

/// Width of the vectors that a program may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vectors {
    /// As wide as the processor has them.
    Wide,
    /// As every processor has them. Old valgrinds do not know all instructions on wider ones.
    Narrow,
}

/// Runs `program` under callgrind with `options`, and returns what callgrind reported.
pub fn callgrind(program: &Path, vectors: Vectors, options: &[&str], arguments: &[&str]) -> Result<String> {
    let out = options.iter().any(|option| option.starts_with("--callgrind-out-file"));
    let output = Command::new("valgrind")
        .args(["--tool=callgrind"])
        .args((!out).then_some("--callgrind-out-file=/dev/null"))
        .args(options)
        .arg(program)
        .args(arguments)
        .envs((vectors == Vectors::Narrow).then_some((lanes::VARIABLE, "narrow")))
        .output()
        .context("valgrind counts the instructions: install it (apt-get install valgrind)")?;
    let report = String::from_utf8_lossy(&output.stderr).into_owned();
    ensure!(output.status.success(), "{arguments:?}: {report}");
    Ok(report)
}

/// Communication steps of the two runs whose difference is counted: starting up cancels.
pub const COUNTED: [u32; 2] = [100, 300];

/// Instructions per communication step of `program` in `scene` with `options`.
pub fn instructions(program: &Path, vectors: Vectors, scene: &str, options: &[&str]) -> Result<f64> {
    let mut counts = [0.0; 2];
    for (count, steps) in counts.iter_mut().zip(COUNTED) {
        let steps = steps.to_string();
        let report = callgrind(program, vectors, &[], &[&[scene, &steps, "unread"], options].concat())?;
        *count = report
            .lines()
            .find_map(|line| line.split("Collected :").nth(1)?.trim().parse().ok())
            .context("valgrind reported no count")?;
    }
    Ok((counts[1] - counts[0]) / f64::from(COUNTED[1] - COUNTED[0]))
}

/// What `measure` gives with the widest vectors that it can count: valgrind may not know an instruction on wider ones.
pub fn counted<T>(measure: impl Fn(Vectors) -> Result<T>) -> Result<(Vectors, T)> {
    match measure(Vectors::Wide) {
        Ok(counts) => Ok((Vectors::Wide, counts)),
        Err(_) => Ok((Vectors::Narrow, measure(Vectors::Narrow)?)),
    }
}

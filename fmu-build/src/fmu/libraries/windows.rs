//! Library for Windows, built with the unpacked tool chain, or with the system's MinGW and rustup's target.

use std::path::Path;
use std::process::Command;

use anyhow::Result;

use super::compile::{cargo, distributable};
use super::library::{AddedPart, CROSS, Library};
use crate::fmu::toolchains::{self, UnpackedToolchain, WINDOWS, WINDOWS_TARGET};

/// True if a tool chain is installed.
pub(super) fn has_x86_64() -> bool {
    CROSS && (WINDOWS.found().is_some() || rustup_has_windows())
}

/// Builds the library if a tool chain is installed.
pub(super) fn x86_64() -> Result<Option<Library>> {
    match WINDOWS.found() {
        Some(tools) if CROSS => for_windows(&tools).map(Some),
        None if CROSS && rustup_has_windows() => for_windows_by_rustup().map(Some),
        _ => Ok(None),
    }
}

fn for_windows(tools: &UnpackedToolchain) -> Result<Library> {
    let programs = tools.programs();
    let mut command = Command::new(cargo());
    command
        .args(["build", "--target", WINDOWS_TARGET, "-Zbuild-std=std,panic_unwind"])
        .env("PATH", toolchains::path_with(&programs)?)
        .env("RUSTC", programs.join("rustc"))
        // Debian's Rust is stable, but building the standard library is an unstable feature
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER", programs.join("x86_64-w64-mingw32-gcc"));
    // separate sections for functions let the linker leave out unused ones
    windows_library(command, &tools.root(), &["-Zfunction-sections=yes"])
}

/// True if rustup's target for Windows and the system's MinGW are installed.
fn rustup_has_windows() -> bool {
    toolchains::has_target(WINDOWS_TARGET) && Command::new("x86_64-w64-mingw32-gcc").arg("--version").output().is_ok()
}

/// Builds the library for Windows with rustup's target and the system's MinGW.
fn for_windows_by_rustup() -> Result<Library> {
    let mut command = Command::new(cargo());
    command.args(["build", "--target", WINDOWS_TARGET]);
    windows_library(command, Path::new("/"), &[])
}

/// Runs `command`, which builds the library with the MinGW under `root`.
fn windows_library(command: Command, root: &Path, options: &[&str]) -> Result<Library> {
    let [file, answers] = distributable(command, "win64", "dll", options)?;
    let text = |package: &str| root.join("usr").join("share").join("doc").join(package).join("copyright");
    let added = vec![
        AddedPart {
            name: "MinGW-w64 runtime",
            licence: "MIT, ZPL-2.1 and public domain",
            text: text("mingw-w64-common"),
        },
        AddedPart {
            name: "libgcc",
            licence: "GPL-3.0-or-later WITH GCC-exception-3.1",
            text: text("gcc-mingw-w64-base"),
        },
    ];
    Ok(Library {
        platform: "win64",
        in_fmi3: vec![("x86_64-windows", file.clone())],
        in_wheels: "win_amd64",
        ending: "dll",
        file,
        answers,
        needs: "Windows on x86-64, no other software".into(),
        added,
    })
}

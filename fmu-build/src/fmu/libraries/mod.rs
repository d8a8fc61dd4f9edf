//! The FMU's library, built for this machine or for other machines by the tool chains that are installed.

pub mod darwin;
pub mod linux;
pub mod own;
pub mod platforms;

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::fmu::toolchains::{self, GLIBC, UnpackedToolchain, WINDOWS, WINDOWS_TARGET};
use crate::tools::{paths, progress};

/// The crate that is the FMU, and the one that answers questions for the Python package.
pub const CRATES: [&str; 2] = ["bevel-differential", "answers"];

/// Whether the tool chains for other machines run here.
pub(super) const CROSS: bool = cfg!(all(target_os = "linux", target_arch = "x86_64"));

/// FMI's name of this machine's platform and the ending of its libraries.
pub(super) const HOST: (&str, &str) = if cfg!(target_os = "windows") {
    ("win64", "dll")
} else if cfg!(target_os = "macos") {
    ("darwin64", "dylib")
} else {
    ("linux64", "so")
};

/// FMI 3.0's name of this machine's platform, as far as the FMU has been built there.
const HOST_IN_FMI3: &str = match (cfg!(target_arch = "aarch64"), HOST.0.as_bytes()) {
    (false, b"win64") => "x86_64-windows",
    (false, b"darwin64") => "x86_64-darwin",
    (false, _) => "x86_64-linux",
    (true, b"win64") => "aarch64-windows",
    (true, b"darwin64") => "aarch64-darwin",
    (true, _) => "aarch64-linux",
};

/// The library for one platform.
#[derive(Clone, Debug)]
pub struct Library {
    /// FMI's name of the platform, in version 2.0.
    pub platform: &'static str,
    /// The names in FMI 3.0, each with its file: where one platform of 2.0 is two of 3.0, parts of the whole.
    pub in_fmi3: Vec<(&'static str, PathBuf)>,
    /// What pip calls the platforms, joined by dots; "this-machine" where it finds out itself.
    pub in_wheels: &'static str,
    /// Ending of the file, without the dot.
    pub ending: &'static str,
    /// What was built.
    pub file: PathBuf,
    /// The library of answers, which was built along with it.
    pub answers: PathBuf,
    /// What a machine needs, in words.
    pub needs: String,
    /// What the linker adds to the crates and Rust's standard library.
    pub added: Vec<AddedPart>,
}

/// A part of a compiler's runtime that is linked in.
#[derive(Clone, Debug)]
pub struct AddedPart {
    /// Its name.
    pub name: &'static str,
    /// Its licence by its SPDX name.
    pub licence: &'static str,
    /// The file with the text.
    pub text: PathBuf,
}

/// The libraries that were built, and which were not with how to get them.
#[derive(Clone, Debug)]
pub struct Libraries {
    /// In the order of the archive.
    pub built: Vec<Library>,
    /// A sentence each.
    pub left_out: Vec<String>,
    /// Whether one is for other machines.
    pub ships: bool,
}

/// Builds the FMU's library with every tool chain that is installed.
pub fn build() -> Result<Libraries> {
    let (mut built, mut left_out) = (Vec::new(), Vec::new());
    let old_linux = linux::x86_64()?;
    let mut ships = old_linux.is_some();
    if CROSS && !ships {
        left_out.push(format!("linux64 is for systems as new as this one, not for glibc {GLIBC}"));
    }
    built.push(old_linux.map_or_else(for_this_machine, Ok)?);
    if !CROSS {
        left_out.push(format!("the FMU holds {} alone", HOST.0));
        return Ok(Libraries { built, left_out, ships });
    }
    let others = [("win64", windows()?), ("aarch64-linux", linux::arm()?), ("darwin64", darwin::universal()?)];
    ships |= others.iter().any(|(_, library)| library.is_some());
    let missing: Vec<&str> = others.iter().filter(|(_, library)| library.is_none()).map(|(name, _)| *name).collect();
    built.extend(others.into_iter().filter_map(|(_, library)| library));
    if !missing.is_empty() {
        left_out.push(format!("left out: {}", missing.join(", ")));
    }
    if let Some(last) = left_out.last_mut() {
        last.push_str(&format!("; to get it: {}", toolchains::COMMAND));
    }
    Ok(Libraries { built, left_out, ships })
}

/// The library for Windows, if a tool chain for it is installed.
pub(super) fn windows() -> Result<Option<Library>> {
    match WINDOWS.found() {
        Some(tools) if CROSS => for_windows(&tools).map(Some),
        None if CROSS && rustup_has_windows() => for_windows_by_rustup().map(Some),
        _ => Ok(None),
    }
}

/// The library as this machine's tools build it: as they built it along with this program, if it can be found.
pub fn for_this_machine() -> Result<Library> {
    let needs = match HOST.0 {
        "linux64" => "Linux on x86-64 as new as the machine that the library was built on",
        "win64" => "Windows on x86-64",
        _ => "macOS",
    };
    let [file, answers] = own::packable().or_else(|why| {
        progress::note(&format!("{why:#}: the library is compiled once more, which takes minutes"));
        let mut command = Command::new(cargo());
        command.arg("build");
        distributable(command, "this-machine", HOST.1, &[])
    })?;
    let in_fmi3 = vec![(HOST_IN_FMI3, file.clone())];
    Ok(Library {
        platform: HOST.0,
        in_fmi3,
        in_wheels: "this-machine",
        ending: HOST.1,
        file,
        answers,
        needs: needs.into(),
        added: Vec::new(),
    })
}

/// Builds the dynamic library of `package`, which is not the FMU's, for this machine with cargo and returns its path.
pub fn build_library(package: &str) -> Result<PathBuf> {
    let mut command = Command::new(cargo());
    // with the program, whose choice of features it shares: what both stand on is compiled once
    command.arg("build").args(["-p", "fmu-build", "--target-dir"]).arg(paths::target());
    let [library] = built_by(command, [package], HOST.1)?;
    Ok(library)
}

fn for_windows(tools: &UnpackedToolchain) -> Result<Library> {
    let programs = tools.programs();
    let mut command = Command::new(cargo());
    command
        .args(["build", "--target", WINDOWS_TARGET, "-Zbuild-std=std,panic_unwind"])
        .env("PATH", toolchains::path_with(&programs)?)
        .env("RUSTC", programs.join("rustc"))
        // Debian's Rust is a stable one, and building the standard library is not yet
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER", programs.join("x86_64-w64-mingw32-gcc"));
    // each function in a section of its own, so that the linker may leave it out
    windows_library(command, &tools.root(), &["-Zfunction-sections=yes"])
}

/// Whether rustup's own target for Windows and the system's MinGW are installed.
pub(super) fn rustup_has_windows() -> bool {
    toolchains::has_target(WINDOWS_TARGET) && Command::new("x86_64-w64-mingw32-gcc").arg("--version").output().is_ok()
}

/// The library for Windows by both.
fn for_windows_by_rustup() -> Result<Library> {
    let mut command = Command::new(cargo());
    command.args(["build", "--target", WINDOWS_TARGET]);
    windows_library(command, Path::new("/"), &[])
}

/// The library that `command` builds with the MinGW under `root`.
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

/// Builds the libraries of [`CRATES`] by `options` of the compiler, without paths of this machine. It has a separate
/// target folder, because the compiler may differ, and its options always do.
pub(super) fn distributable(mut command: Command, name: &str, ending: &str, options: &[&str]) -> Result<[PathBuf; 2]> {
    let options: Vec<String> =
        without_folders().into_iter().chain(options.iter().map(|&option| option.into())).collect();
    command
        .arg("--target-dir")
        .arg(paths::target().join("cross").join(name))
        // whatever the rest is built with: one unit inlines what matters
        .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "1")
        .env("CARGO_ENCODED_RUSTFLAGS", options.join("\u{1f}"));
    built_by(command, CRATES, ending).with_context(|| format!("the library for {name}"))
}

/// Options that replace the folders of this machine in the locations of panics.
pub(super) fn without_folders() -> Vec<String> {
    // of several that match, the last one counts
    let folders = folders().into_iter().rev();
    folders.map(|(folder, name)| format!("--remap-path-prefix={}={name}", folder.display())).collect()
}

/// Folders of this machine that compilers write into libraries, and what stands for them; the longest first.
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

/// The libraries that `command`, cargo with a target, builds of `packages`. In one go, so that what they share is compiled once.
fn built_by<const N: usize>(mut command: Command, packages: [&str; N], ending: &str) -> Result<[PathBuf; N]> {
    let output = command
        .current_dir(paths::workspace())
        .args(["--release", "--lib", "--quiet", "--message-format", "json-render-diagnostics"])
        .args(packages.iter().flat_map(|package| ["-p", package]))
        .output()
        .with_context(|| format!("{} cannot be run", command.get_program().display()))?;
    if !output.status.success() {
        bail!("the library does not build:\n{}", String::from_utf8_lossy(&output.stderr).trim_end());
    }
    let artifacts = String::from_utf8_lossy(&output.stdout);
    let built = packages.map(|package| {
        let crate_name = package.replace('-', "_");
        artifacts.lines().filter_map(|line| library_in(line, &crate_name, ending)).next_back()
    });
    let complete: Option<Vec<PathBuf>> = built.into_iter().collect();
    complete.and_then(|built| built.try_into().ok()).with_context(|| format!("cargo built no .{ending} file"))
}

/// The dynamic library of a crate named in one line of cargo's messages.
fn library_in(line: &str, crate_name: &str, ending: &str) -> Option<PathBuf> {
    let message: serde_json::Value = serde_json::from_str(line).ok()?;
    let is_cdylib = message["target"]["kind"].as_array()?.iter().any(|kind| kind == "cdylib");
    let files = message["filenames"].as_array()?.iter().filter_map(|name| name.as_str()).map(Path::new);
    let mut libraries = files.filter(|file| file.extension().is_some_and(|found| found == ending));
    let is_meant = is_cdylib && message["target"]["name"] == crate_name;
    if is_meant { libraries.next().map(Path::to_path_buf) } else { None }
}

/// The cargo that runs this program, or the one in PATH.
pub fn cargo() -> std::ffi::OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

//! Library for this machine. The library that cargo built together with this program is used, so that nothing is
//! compiled twice.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use anyhow::{Context, Result, ensure};

use super::compile::{cargo, distributable, folders};
use super::library::{CRATES, HOST, Library};
use crate::tools::files::make_whole;
use crate::tools::{paths, progress};

/// FMI 3.0's name of this machine's platform.
const HOST_IN_FMI3: &str = match (cfg!(target_arch = "aarch64"), HOST.0.as_bytes()) {
    (false, b"win64") => "x86_64-windows",
    (false, b"darwin64") => "x86_64-darwin",
    (false, _) => "x86_64-linux",
    (true, b"win64") => "aarch64-windows",
    (true, b"darwin64") => "aarch64-darwin",
    (true, _) => "aarch64-linux",
};

/// Minimum number of separators in a folder that [`overwrite`] replaces. A short folder such as `/src` may be in the
/// middle of any path, and reveals nothing about a machine.
const FEWEST_SEPARATORS: usize = 2;

/// Returns the library for this machine. If the one built together with this program cannot be used, it is compiled
/// again.
pub fn for_this_machine() -> Result<Library> {
    let needs = match HOST.0 {
        "linux64" if cfg!(target_arch = "aarch64") => {
            "Linux on 64-bit ARM, as new as the machine that built the library"
        }
        "linux64" => "Linux on x86-64, as new as the machine that built the library",
        "win64" => "Windows on x86-64",
        _ => "macOS",
    };
    let [file, answers] = packable().or_else(|why| {
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

/// Finds the FMU's library that cargo built next to this program. The error states why it cannot be used.
pub fn beside_program() -> Result<PathBuf> {
    beside(CRATES[0])
}

/// Finds the library of `package` that cargo built next to this program.
fn beside(package: &str) -> Result<PathBuf> {
    ensure!(!cfg!(debug_assertions), "this program was built without --release");
    let program = env::current_exe().context("the path of this program is unknown")?;
    let library = paths::built(package)?;
    // one compilation links program and library, the program last, so a newer library is from another compilation
    let written = |file: &Path| -> Result<SystemTime> {
        let modified = fs::metadata(file).and_then(|metadata| metadata.modified());
        modified.with_context(|| format!("{} is not there", paths::shown(file)))
    };
    ensure!(
        written(&library)? <= written(&program)?,
        "{} is newer than this program: it was built with other options",
        paths::shown(&library)
    );
    Ok(library)
}

/// Copies of the libraries of [`CRATES`] without the folders of this machine.
fn packable() -> Result<[PathBuf; 2]> {
    let [fmu, answers] = CRATES.map(|package| beside(package).and_then(|library| cleaned(&library)));
    Ok([fmu?, answers?])
}

/// Copies `library` without the folders of this machine.
fn cleaned(library: &Path) -> Result<PathBuf> {
    let mut content = fs::read(library).with_context(|| format!("{} cannot be read", paths::shown(library)))?;
    for (folder, name) in folders() {
        overwrite(&mut content, folder.as_os_str().as_encoded_bytes(), name.as_bytes());
    }
    let folder = paths::target().join("cross").join("this-machine");
    let copy = folder.join(library.file_name().unwrap_or_default());
    make_whole(&copy, |part| {
        fs::write(part, &content).with_context(|| format!("{} cannot be written", paths::shown(&copy)))?;
        if cfg!(target_os = "macos") { sign(part) } else { Ok(()) }
    })?;
    Ok(copy)
}

/// Renews the signature of a library, because macOS ends a process that loads pages whose hashes differ from the
/// linker's signature.
fn sign(library: &Path) -> Result<()> {
    let output = Command::new("codesign").args(["--force", "--sign", "-"]).arg(library).output();
    let output = output.context("codesign, which is part of macOS, cannot be run")?;
    ensure!(output.status.success(), "codesign: {}", String::from_utf8_lossy(&output.stderr).trim());
    Ok(())
}

/// Overwrites each `folder` in the library `content` with `name`, if a separator follows. Separators fill the remaining
/// length, so that nothing moves; repeated separators count as one. The start of a path cannot be checked, because
/// strings in a library follow each other without a gap.
fn overwrite(content: &mut [u8], folder: &[u8], name: &[u8]) {
    let is_separator = |byte: &u8| *byte == b'/' || (cfg!(windows) && *byte == b'\\');
    if folder.iter().filter(|&byte| is_separator(byte)).count() < FEWEST_SEPARATORS {
        return;
    }
    let found: Vec<usize> = content
        .windows(folder.len() + 1)
        .enumerate()
        .filter(|(_, bytes)| bytes.starts_with(folder) && bytes.last().is_some_and(is_separator))
        .map(|(at, _)| at)
        .collect();
    for at in found {
        let place = &mut content[at..at + folder.len()];
        place.fill(std::path::MAIN_SEPARATOR as u8);
        let kept = name.len().min(place.len());
        place[..kept].copy_from_slice(&name[..kept]);
    }
}

#[cfg(test)]
mod tests {
    use super::overwrite;

    fn overwritten(text: &str, folder: &str, name: &str) -> String {
        let mut content = text.as_bytes().to_vec();
        overwrite(&mut content, folder.as_bytes(), name.as_bytes());
        String::from_utf8(content).unwrap()
    }

    #[test]
    fn a_folder_is_overwritten_at_equal_length_and_the_remaining_path_is_kept() {
        let text = "src/a.rs/home/me/crates/b-1.0/src/lib.rs/home/merry/c.rs";
        assert_eq!(overwritten(text, "/home/me", "cargo"), "src/a.rscargo////crates/b-1.0/src/lib.rs/home/merry/c.rs");
        assert_eq!(overwritten("/opt/x/y.rs", "/opt/x", "toolchains"), "toolch/y.rs");
    }

    #[test]
    fn a_folder_that_may_be_in_the_middle_of_any_path_is_kept() {
        assert_eq!(overwritten("b-1.0/src/lib.rs", "/src", "project"), "b-1.0/src/lib.rs");
    }
}

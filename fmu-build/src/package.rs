//! The .fmu archive: the library, its description, documentation and licences; the same bytes every time.

use std::env;
use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use bevel_differential::variables::MODEL_NAME;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use crate::{describe, documentation, places};

/// FMI's name of this machine's platform and the ending of its libraries.
const PLATFORM: (&str, &str) = if cfg!(target_os = "windows") {
    ("win64", "dll")
} else if cfg!(target_os = "macos") {
    ("darwin64", "dylib")
} else {
    ("linux64", "so")
};

/// Permissions of the archive's files.
const PLAIN: u32 = 0o644;
const EXECUTABLE: u32 = 0o755;

/// A file of the archive.
struct Entry {
    path: String,
    content: Vec<u8>,
    permissions: u32,
}

/// Builds the library and packs the FMU to its usual place.
pub fn package() -> Result<PathBuf> {
    let library = build_library("bevel-differential")?;
    let target = places::fmu();
    write_archive(&library, &target)?;
    Ok(target)
}

/// Builds the dynamic library of `package` with cargo, quietly, and tells where it is.
pub fn build_library(package: &str) -> Result<PathBuf> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(&cargo)
        .current_dir(places::workspace())
        .args(["build", "--release", "-p", package, "--lib", "--quiet"])
        .args(["--message-format", "json-render-diagnostics", "--target-dir"])
        .arg(places::target())
        .output()
        .with_context(|| format!("{} cannot be run", cargo.display()))?;
    if !output.status.success() {
        bail!("the library does not build:\n{}", String::from_utf8_lossy(&output.stderr).trim_end());
    }
    let artifacts = String::from_utf8_lossy(&output.stdout);
    let library = artifacts.lines().filter_map(library_in).next_back();
    library.with_context(|| format!("cargo built no .{} file", PLATFORM.1))
}

/// The dynamic library named in one line of cargo's messages.
fn library_in(line: &str) -> Option<PathBuf> {
    let message: serde_json::Value = serde_json::from_str(line).ok()?;
    let is_cdylib = message["target"]["kind"].as_array()?.iter().any(|kind| kind == "cdylib");
    let files = message["filenames"].as_array()?.iter().filter_map(|name| name.as_str()).map(Path::new);
    let mut libraries = files.filter(|file| file.extension().is_some_and(|ending| ending == PLATFORM.1));
    if is_cdylib { libraries.next().map(Path::to_path_buf) } else { None }
}

/// Packs the FMU around `library` into `target`, which appears at once or not at all.
pub fn write_archive(library: &Path, target: &Path) -> Result<()> {
    let bytes = archive(&entries(library)?).context("the archive cannot be made")?;
    let folder = target.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    let partial = target.with_extension(format!("{}.part", std::process::id()));
    fs::write(&partial, bytes)
        .and_then(|()| fs::rename(&partial, target))
        .with_context(|| format!("{} cannot be written", target.display()))
}

fn entries(library: &Path) -> Result<Vec<Entry>> {
    let plain = |path: &str, content: Vec<u8>| Entry { path: path.into(), content, permissions: PLAIN };
    let read = |file: &Path| fs::read(file).with_context(|| format!("{} cannot be read", file.display()));
    let mut entries = vec![
        plain("modelDescription.xml", describe::model_description()?.into_bytes()),
        Entry {
            path: format!("binaries/{}/{MODEL_NAME}.{}", PLATFORM.0, PLATFORM.1),
            content: read(library)?,
            permissions: EXECUTABLE,
        },
        plain("documentation/index.html", documentation::page()?.into_bytes()),
    ];
    for name in licences()? {
        entries.push(plain(&format!("documentation/licenses/{name}"), read(&places::workspace().join(&name))?));
    }
    let picture = places::workspace().join("fmu-build").join("model.png");
    if picture.is_file() {
        entries.push(plain("model.png", read(&picture)?));
    }
    Ok(entries)
}

/// Names of the licence files at the top of the workspace, sorted.
fn licences() -> Result<Vec<String>> {
    let mut names: Vec<String> = fs::read_dir(places::workspace())?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.starts_with("LICENSE"))
        .collect();
    names.sort();
    Ok(names)
}

fn archive(entries: &[Entry]) -> Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for entry in entries {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::default())
            .unix_permissions(entry.permissions);
        zip.start_file(entry.path.as_str(), options)?;
        zip.write_all(&entry.content)?;
    }
    Ok(zip.finish()?.into_inner())
}

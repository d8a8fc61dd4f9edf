//! Licences of everything that is linked into the library: the licences of the project, of its crates from cargo's
//! copies of their sources, and of the parts that compilers add.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use serde_json::Value;

use crate::fmu::libraries::{Library, cargo};
use crate::tools::paths;

/// Prefixes of the names of licence files, in lower case.
const NAMES: [&str; 6] = ["license", "licence", "copying", "copyright", "notice", "unlicense"];
/// A licence with one common text, and the file of that text.
const COMMON: (&str, &str) = ("Apache-2.0", "LICENSE-APACHE");

/// A linked part with its licence.
pub struct LinkedPart {
    /// Name and version.
    pub name: String,
    /// SPDX name of the licence.
    pub licence: String,
    /// Paths of the licence texts.
    pub files: Vec<String>,
}

/// All licence files, and the parts to which they belong.
pub struct Licences {
    /// Files of documentation/licenses with their texts, sorted by path.
    pub files: Vec<(String, Vec<u8>)>,
    /// Linked parts.
    pub linked: Vec<LinkedPart>,
}

/// Collects the licences of `libraries` of the crate `package`. Fails if a part has no licence text.
pub fn collected(package: &str, libraries: &[Library]) -> Result<Licences> {
    let mut found = Licences { files: Vec::new(), linked: Vec::new() };
    for (name, (folder, licence)) in linked_crates(package)? {
        let place = if folder == paths::workspace() { String::new() } else { format!("{name}/") };
        let texts = texts_in(&folder)?;
        let mut files: Vec<String> = texts.iter().map(|(file, _)| format!("{place}{file}")).collect();
        found.files.extend(files.iter().cloned().zip(texts.into_iter().map(|(_, text)| text)));
        if files.is_empty() && licence.contains(COMMON.0) {
            files.push(COMMON.1.to_owned());
        }
        ensure!(
            !files.is_empty(),
            "{name} ({}) has no file with the text of its licence \"{licence}\"; do not link it",
            folder.display()
        );
        found.linked.push(LinkedPart { name, licence, files });
    }
    standard_library(&mut found)?;
    for library in libraries {
        for part in &library.added {
            let file = format!("{}/{}.txt", library.platform, part.name.replace(' ', "-"));
            add(&mut found, part.name, part.licence, file, &part.text)?;
        }
    }
    found.files.sort();
    Ok(found)
}

/// Adds Rust's standard library, whose notices come with rustc.
fn standard_library(found: &mut Licences) -> Result<()> {
    let output = Command::new("rustc").args(["--print", "sysroot"]).output().context("rustc cannot be run")?;
    let root = PathBuf::from(String::from_utf8_lossy(&output.stdout).trim());
    let folder = root.join("share").join("doc").join("rust");
    let notices = ["COPYRIGHT-library.html", "COPYRIGHT"].map(|name| folder.join(name));
    let Some(notice) = notices.iter().find(|file| file.is_file()) else {
        // other packages of the compiler keep the notices elsewhere; the licences are the same as those of this project
        found.linked.push(LinkedPart {
            name: "Rust standard library".into(),
            licence: "MIT OR Apache-2.0".into(),
            files: vec![COMMON.1.into()],
        });
        return Ok(());
    };
    let name = notice.file_name().unwrap_or_default().display();
    // a text file without an extension would not open on a double click
    let ending = if notice.extension().is_some() { "" } else { ".txt" };
    add(found, "Rust standard library", "MIT OR Apache-2.0", format!("std/{name}{ending}"), notice)
}

fn add(found: &mut Licences, name: &str, licence: &str, path: String, source: &Path) -> Result<()> {
    let text = fs::read(source).with_context(|| format!("the licence of {name}, {}, is missing", source.display()))?;
    found.files.push((path.clone(), text));
    found.linked.push(LinkedPart { name: name.into(), licence: licence.into(), files: vec![path] });
    Ok(())
}

/// Crates linked into the library on any platform, by name and version, each with its folder and licence.
fn linked_crates(package: &str) -> Result<BTreeMap<String, (PathBuf, String)>> {
    let tree =
        cargo_output(&["tree", "-p", package, "-e", "normal,no-proc-macro", "--target", "all", "--prefix", "none"])?;
    let crate_of = |line: &str| {
        let (name, rest) = line.split_once(' ')?;
        Some((name.to_owned(), rest.split(' ').next()?.strip_prefix('v')?.to_owned()))
    };
    let wanted: BTreeSet<(String, String)> = tree.lines().filter_map(crate_of).collect();
    let metadata: Value = serde_json::from_str(&cargo_output(&["metadata", "--format-version", "1"])?)?;
    let packages = metadata["packages"].as_array().context("cargo metadata names no packages")?;
    let mut crates = BTreeMap::new();
    for (name, version) in wanted {
        let package = packages.iter().find(|p| p["name"] == *name && p["version"] == *version);
        let manifest = package.and_then(|p| p["manifest_path"].as_str());
        let Some(folder) = manifest.and_then(|manifest| Path::new(manifest).parent()) else {
            bail!("cargo metadata does not know {name} {version}")
        };
        let licence = package.and_then(|p| p["license"].as_str()).unwrap_or("not named").replace('/', " OR ");
        crates.insert(format!("{name}-{version}"), (folder.to_path_buf(), licence));
    }
    ensure!(crates.len() > 1, "cargo tree names no crates that the library links");
    Ok(crates)
}

/// Licence files in `folder`, sorted by name.
fn texts_in(folder: &Path) -> Result<Vec<(String, Vec<u8>)>> {
    let mut texts = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| format!("{} cannot be read", folder.display()))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.path().is_file() && NAMES.iter().any(|begin| name.to_lowercase().starts_with(begin)) {
            texts.push((name, fs::read(entry.path())?));
        }
    }
    texts.sort();
    Ok(texts)
}

fn cargo_output(arguments: &[&str]) -> Result<String> {
    let output = Command::new(cargo()).current_dir(paths::workspace()).args(arguments).arg("--locked").output();
    let output = output.context("cargo cannot be run")?;
    ensure!(
        output.status.success(),
        "cargo {} failed: {}",
        arguments[0],
        String::from_utf8_lossy(&output.stderr).trim_end()
    );
    Ok(String::from_utf8(output.stdout)?)
}

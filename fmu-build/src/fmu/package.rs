//! The .fmu archive: the libraries, their description, documentation and licences; the same bytes every time.

use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use bevel_differential::variables::MODEL_NAME;
use clap::Args;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use crate::fmu::libraries::{self, CRATES, Library};
use crate::fmu::page::{self, Page};
use crate::fmu::{describe, documentation, effect_list, licences, plain_types};
use crate::tools::paths;
use crate::tools::progress::Progress;

pub use crate::fmu::libraries::build_library;

/// Permissions of the archive's files.
const PLAIN: u32 = 0o644;
const EXECUTABLE: u32 = 0o755;

/// How an archive is compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    /// In little time, for this machine.
    Quick,
    /// To little size, for shipping.
    Small,
}

impl Packing {
    /// The level of deflate.
    fn level(self) -> i64 {
        match self {
            Self::Quick => 1,
            Self::Small => 9,
        }
    }
}

/// A file of the archive.
struct ArchiveFile {
    path: String,
    content: Vec<u8>,
    permissions: u32,
}

/// Builds target/fmu/BevelDifferential.fmu for every platform whose tool chain is installed
#[derive(Args, Clone, Debug)]
pub struct PackageCommand {
    /// Also build BevelDifferential_integers.fmu, for hosts without enumerations (libcosim, Ecos)
    #[arg(long)]
    integers: bool,
}

impl PackageCommand {
    /// Packages the FMU and prints where it is.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("packaging the FMU");
        let packed = packed()?;
        let plain = if self.integers { Some(plain_types::package(&packed.fmu)?) } else { None };
        progress.finish();
        for file in std::iter::once(&packed.fmu).chain(&plain) {
            println!("{}", paths::shown(file));
        }
        if !packed.left_out.is_empty() {
            println!("{}", packed.left_out.join("; "));
        }
        Ok(())
    }
}

/// A packed FMU.
pub struct PackedFmu {
    /// The archive.
    pub fmu: PathBuf,
    /// What it holds no library for, and how to get it.
    pub left_out: Vec<String>,
}

/// Builds the library with every installed tool chain and packs the FMU to its usual place.
pub fn package() -> Result<PathBuf> {
    packed().map(|packed| packed.fmu)
}

/// The same, with what was left out.
pub fn packed() -> Result<PackedFmu> {
    let libraries = libraries::build()?;
    let fmu = paths::fmu();
    let page = Page::found()?;
    let packing = if libraries.ships { Packing::Small } else { Packing::Quick };
    write_archive(&libraries.built, page.text(), packing, &fmu)?;
    effect_list::write_json(&fmu)?;
    let mut left_out = libraries.left_out;
    if page.text().is_none() {
        left_out.push(page.remark());
    }
    Ok(PackedFmu { fmu, left_out })
}

/// Packs the FMU around `libraries`, and with the page if it is given, into `target`, which is complete or not there.
pub fn write_archive(libraries: &[Library], page: Option<&[u8]>, packing: Packing, target: &Path) -> Result<()> {
    let bytes = archive(&entries(libraries, page)?, packing).context("the archive cannot be created")?;
    let folder = target.parent().unwrap_or(Path::new("."));
    paths::create_folder(folder)?;
    let partial = target.with_extension(format!("{}.part", std::process::id()));
    fs::write(&partial, bytes)
        .and_then(|()| fs::rename(&partial, target))
        .with_context(|| format!("{} cannot be written", target.display()))
}

fn entries(libraries: &[Library], page: Option<&[u8]>) -> Result<Vec<ArchiveFile>> {
    let plain = |path: String, content: Vec<u8>| ArchiveFile { path, content, permissions: PLAIN };
    let read = |file: &Path| fs::read(file).with_context(|| format!("{} cannot be read", file.display()));
    let mut entries = vec![plain("modelDescription.xml".into(), describe::model_description()?.into_bytes())];
    for library in libraries {
        let path = format!("binaries/{}/{MODEL_NAME}.{}", library.platform, library.ending);
        entries.push(ArchiveFile { path, content: read(&library.file)?, permissions: EXECUTABLE });
    }
    let licences = licences::collected(CRATES[0], libraries)?;
    let live = page.map(|_| page::FILE);
    let index = documentation::page(libraries, &licences.linked, live)?;
    entries.push(plain("documentation/index.html".into(), index.into_bytes()));
    if let Some(page) = page {
        entries.push(plain(format!("documentation/{}", page::FILE), page.to_vec()));
    }
    for figure in documentation::FIGURES {
        let file = figure.file.iter().fold(paths::workspace(), |path, part| path.join(part));
        entries.push(plain(format!("documentation/{}", figure.name()), read(&file)?));
    }
    for licence in licences.files {
        entries.push(plain(format!("documentation/licenses/{}", licence.path), licence.text));
    }
    let picture = paths::workspace().join("fmu-build").join("model.png");
    entries.push(plain("model.png".into(), read(&picture)?));
    Ok(entries)
}

fn archive(entries: &[ArchiveFile], packing: Packing) -> Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for entry in entries {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(packing.level()))
            .last_modified_time(DateTime::default())
            .unix_permissions(entry.permissions);
        zip.start_file(entry.path.as_str(), options)?;
        zip.write_all(&entry.content)?;
    }
    Ok(zip.finish()?.into_inner())
}

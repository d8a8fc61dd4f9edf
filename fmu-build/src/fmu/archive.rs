//! The .fmu archive: libraries, their description, documentation and licences. The same sources give the same bytes.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use anyhow::{Context, Result};
use bevel_differential::variables::MODEL_NAME;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use crate::fmu::libraries::{CRATES, Library};
use crate::fmu::{describe, describe3, documentation, evidence, licences, page, terminals};
use crate::tools::files::write_whole;
use crate::tools::paths;

/// Permissions of files in the archive.
const PLAIN: u32 = 0o644;
const EXECUTABLE: u32 = 0o755;

/// Compression level of an archive (deflate).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    /// Fast, for this machine.
    Quick = 1,
    /// Small, for shipping.
    Small = 9,
}

/// FMI version of an archive. Both versions contain the same library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

impl Version {
    /// Folders and files of a platform's library.
    fn binaries(self, library: &Library) -> Vec<(&'static str, &Path)> {
        match self {
            Self::Two => vec![(library.platform, &library.file)],
            Self::Three => library.in_fmi3.iter().map(|(name, file)| (*name, file.as_path())).collect(),
        }
    }

    fn description(self) -> Result<String> {
        match self {
            Self::Two => describe::model_description(describe::Choices::Enumerations),
            Self::Three => describe3::model_description(),
        }
    }

    fn icon(self) -> &'static str {
        if self == Self::Two { "model.png" } else { "terminalsAndIcons/icon.png" }
    }
}

/// Packs `libraries`, and the page if it is given, into the FMU `target`. The file is either complete or missing.
pub fn write_archive(
    version: Version,
    libraries: &[Library],
    page: Option<&[u8]>,
    packing: Packing,
    target: &Path,
) -> Result<()> {
    write_whole(target, &archive(version, libraries, page, packing).context("the archive cannot be created")?)
}

fn archive(version: Version, libraries: &[Library], page: Option<&[u8]>, packing: Packing) -> Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let mut add = |path: &str, content: &[u8], permissions: u32| -> Result<()> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(packing as i64))
            .last_modified_time(DateTime::default())
            .unix_permissions(permissions);
        zip.start_file(path, options)?;
        Ok(zip.write_all(content)?)
    };
    let read = |file: &Path| fs::read(file).with_context(|| format!("{} cannot be read", file.display()));
    add("modelDescription.xml", version.description()?.as_bytes(), PLAIN)?;
    add(terminals::FILE, terminals::text()?.as_bytes(), PLAIN)?;
    let evidence = evidence::files()?;
    for (path, content) in &evidence {
        add(path, content, PLAIN)?;
    }
    for library in libraries {
        for (platform, file) in version.binaries(library) {
            add(&format!("binaries/{platform}/{MODEL_NAME}.{}", library.ending), &read(file)?, EXECUTABLE)?;
        }
    }
    let licences = licences::collected(CRATES[0], libraries)?;
    let tests = (!evidence.is_empty()).then_some(evidence::DOCUMENT);
    let beside = documentation::Beside { live: page.map(|_| page::FILE), tests };
    let index = documentation::page(libraries, &licences.linked, &beside)?;
    add("documentation/index.html", index.as_bytes(), PLAIN)?;
    if let Some(page) = page {
        add(&format!("documentation/{}", page::FILE), page, PLAIN)?;
    }
    for figure in documentation::FIGURES {
        let file = figure.file.iter().fold(paths::workspace(), |path, part| path.join(part));
        add(&format!("documentation/{}", figure.name()), &read(&file)?, PLAIN)?;
    }
    for (path, text) in licences.files {
        add(&format!("documentation/licenses/{path}"), &text, PLAIN)?;
    }
    add(version.icon(), &read(&paths::workspace().join("fmu-build").join("model.png"))?, PLAIN)?;
    Ok(zip.finish()?.into_inner())
}

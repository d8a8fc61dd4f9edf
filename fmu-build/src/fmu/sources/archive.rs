//! Archive with sources in C: the FMU without its libraries and the files that belong to them, with a description of
//! the features of the sources.

use std::fs::File as Archive;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

use super::{File, Tools};
use crate::fmu::archive::Packing;
use crate::fmu::libraries::{CRATES, Library};
use crate::fmu::{describe, documentation, licences};
use crate::tools::files::write_whole;

/// Level of compression: beyond 9 a slower search for a smaller result, here with the fewest iterations.
const SMALLEST: i64 = 10;
const DESCRIPTION: &str = "modelDescription.xml";
const INDEX: &str = "documentation/index.html";
/// Parts of the FMU that are left out: libraries, their evidence, and the page, which contains a library.
const LEFT_OUT: [&str; 4] = ["binaries/", "extra/", "documentation/fmi-ls-ref", "documentation/BevelDifferential.html"];
/// Requirements of the sources, as text.
const NEEDS: &str = "A C99 compiler with IEEE 754 arithmetic, and from its library setjmp, string functions, roots and rounding. Co-simulation \
                     with the methods fixed_step and adaptive; gears ideal, lumped or tooth; all effects; no derivatives of outputs";

/// Writes the archive with the sources next to `fmu` and returns its path.
pub fn package(tools: &Tools, packing: Packing, fmu: &Path) -> Result<PathBuf> {
    let name = fmu.file_stem().unwrap_or_default().to_string_lossy();
    let target = fmu.with_file_name(format!("{name}_sources.fmu"));
    let files = tools.files(packing)?;
    let bytes = variant(fmu, &files).with_context(|| format!("{} cannot be packed", target.display()))?;
    write_whole(&target, &bytes)?;
    Ok(target)
}

fn variant(fmu: &Path, files: &[File]) -> Result<Vec<u8>> {
    let mut archive = ZipArchive::new(Archive::open(fmu)?)?;
    let mut out = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(SMALLEST))
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let add = |out: &mut ZipWriter<_>, name: &str, text: &str| -> Result<()> {
        out.start_file(name, options)?;
        Ok(out.write_all(text.as_bytes())?)
    };
    for index in 0..archive.len() {
        let name = archive.by_index_raw(index)?.name()?.into_owned();
        if LEFT_OUT.iter().any(|part| name.starts_with(part)) {
            continue;
        }
        match &name[..] {
            DESCRIPTION => add(&mut out, DESCRIPTION, &describe::model_description_of_sources(compiled(files))?)?,
            INDEX => add(&mut out, INDEX, &index_page()?)?,
            _ => out.raw_copy_file(archive.by_index_raw(index)?)?,
        }
    }
    for (name, text) in files {
        add(&mut out, &format!("sources/{name}"), text)?;
    }
    Ok(out.finish()?.into_inner())
}

/// Files to compile, without headers.
fn compiled(files: &[File]) -> impl Iterator<Item = &str> {
    files.iter().map(|(name, _)| name.as_str()).filter(|name| name.ends_with(".c"))
}

/// Documentation page of the archive.
fn index_page() -> Result<String> {
    let sources = Library {
        platform: "sources",
        in_fmi3: Vec::new(),
        in_wheels: "",
        ending: "c",
        file: PathBuf::new(),
        answers: PathBuf::new(),
        needs: NEEDS.to_owned(),
        added: Vec::new(),
    };
    let linked = licences::collected(CRATES[0], &[])?.linked;
    documentation::page(&[sources], &linked, &documentation::Beside { live: None, tests: None })
}

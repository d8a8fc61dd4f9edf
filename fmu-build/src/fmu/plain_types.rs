//! FMU for hosts without enumerations: the same archive with integers instead of enumerations in its description.
//!
//! libcosim and Ecos skip Enumeration variables and therefore cannot set any choice. FMI sets both types with
//! fmi2SetInteger, so the library needs no change.

use std::fs::File;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use zip::write::SimpleFileOptions;
use zip::{DateTime, ZipArchive, ZipWriter};

use crate::fmu::describe::{Choices, model_description};
use crate::tools::files::write_whole;

const DESCRIPTION: &str = "modelDescription.xml";

/// Writes the variant of `fmu` next to it and returns the path.
pub fn package(fmu: &Path) -> Result<PathBuf> {
    let name = fmu.file_stem().unwrap_or_default().to_string_lossy();
    let target = fmu.with_file_name(format!("{name}_integers.fmu"));
    let bytes = variant(fmu).with_context(|| format!("{} cannot be given another description", fmu.display()))?;
    write_whole(&target, &bytes)?;
    Ok(target)
}

fn variant(fmu: &Path) -> Result<Vec<u8>> {
    let mut archive = ZipArchive::new(File::open(fmu)?)?;
    let mut out = ZipWriter::new(Cursor::new(Vec::new()));
    for index in 0..archive.len() {
        if archive.by_index_raw(index)?.name()? != DESCRIPTION {
            out.raw_copy_file(archive.by_index_raw(index)?)?;
            continue;
        }
        out.start_file(DESCRIPTION, SimpleFileOptions::default().last_modified_time(DateTime::default()))?;
        out.write_all(model_description(Choices::Integers)?.as_bytes())?;
    }
    Ok(out.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use crate::fmu::describe::{Choices, model_description};

    #[test]
    fn every_enumeration_becomes_an_integer_whose_description_names_the_choices() {
        let [usual, plain] =
            [Choices::Enumerations, Choices::Integers].map(|c| model_description(c).expect("a description"));
        let count = |text: &str, part: &str| text.matches(part).count();
        let enumerations = count(&usual, "<Enumeration declaredType=");
        assert!(enumerations > 5);
        assert_eq!(count(&plain, "<Enumeration"), 0);
        assert_eq!(count(&plain, "declaredType"), 0);
        assert_eq!(count(&plain, "<Integer"), count(&usual, "<Integer") + enumerations);
        assert!(plain.contains("Spin of the planets on their pins: 1 = free, 2 = imposed\""));
        assert_eq!(count(&plain, "<ScalarVariable"), count(&usual, "<ScalarVariable"));
    }
}

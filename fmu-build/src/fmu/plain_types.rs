//! The FMU for hosts that know no enumerations: the same library, described with Integers in their place.
//!
//! libcosim and Ecos leave Enumeration variables out, so that none of the choices can be made there. FMI sets both by
//! fmi2SetInteger; the library cannot tell the difference.

use std::fs::{self, File};
use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use zip::write::SimpleFileOptions;
use zip::{DateTime, ZipArchive, ZipWriter};

const DESCRIPTION: &str = "modelDescription.xml";

/// Writes the variant of `fmu` beside it, and tells where it is.
pub fn package(fmu: &Path) -> Result<PathBuf> {
    let name = fmu.file_stem().unwrap_or_default().to_string_lossy();
    let target = fmu.with_file_name(format!("{name}_integers.fmu"));
    let bytes = variant(fmu).with_context(|| format!("{} cannot be described anew", fmu.display()))?;
    let partial = target.with_extension(format!("{}.part", std::process::id()));
    fs::write(&partial, bytes)
        .and_then(|()| fs::rename(&partial, &target))
        .with_context(|| format!("{} cannot be written", target.display()))?;
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
        let mut text = String::new();
        archive.by_index(index)?.read_to_string(&mut text)?;
        out.start_file(DESCRIPTION, SimpleFileOptions::default().last_modified_time(DateTime::default()))?;
        out.write_all(with_integers(&text).as_bytes())?;
    }
    Ok(out.finish()?.into_inner())
}

/// The description, which has one element per line, with Integers for Enumerations; their literals go into the
/// descriptions of the variables.
fn with_integers(description: &str) -> String {
    let mut types: Vec<(String, Vec<String>)> = Vec::new();
    let mut out: Vec<String> = Vec::new();
    let mut in_types = false;
    for line in description.lines() {
        let element = line.trim_start();
        if element.starts_with("<TypeDefinitions") {
            in_types = true;
        }
        if in_types {
            match (attribute(element, "name"), types.last_mut()) {
                (Some(name), _) if element.starts_with("<SimpleType") => types.push((name.to_owned(), Vec::new())),
                (Some(name), Some((_, literals))) if element.starts_with("<Item") => literals.push(name.to_owned()),
                _ => (),
            }
            in_types = !element.starts_with("</TypeDefinitions");
            continue;
        }
        let kind = if element.starts_with("<Enumeration") { attribute(element, "declaredType") } else { None };
        match types.iter().find(|(name, _)| Some(name.as_str()) == kind) {
            Some((_, literals)) => {
                let start = attribute(element, "start").unwrap_or("1");
                let indent = &line[..line.len() - element.len()];
                tell_literals(&mut out, literals);
                out.push(format!("{indent}<Integer min=\"1\" max=\"{}\" start=\"{start}\"/>", literals.len()));
            }
            None => out.push(line.to_owned()),
        }
    }
    out.join("\n") + "\n"
}

/// Adds the numbers of the literals to the description of the variable whose line came last.
fn tell_literals(lines: &mut [String], literals: &[String]) {
    let told: Vec<String> = (1..).zip(literals).map(|(number, name)| format!("{number} = {name}")).collect();
    if let Some(line) = lines.last_mut()
        && let Some(description) = attribute(line, "description").map(str::to_owned)
    {
        let longer = format!("description=\"{description}: {}\"", told.join(", "));
        *line = line.replacen(&format!("description=\"{description}\""), &longer, 1);
    }
}

/// Value of an attribute in the text of an element.
fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

#[cfg(test)]
mod tests {
    use super::with_integers;
    use crate::fmu::describe;

    #[test]
    fn every_enumeration_becomes_an_integer_that_tells_its_literals() {
        let description = describe::model_description().expect("the description is made");
        let plain = with_integers(&description);
        let count = |text: &str, part: &str| text.matches(part).count();
        let enumerations = count(&description, "<Enumeration declaredType=");
        assert!(enumerations > 5);
        assert_eq!(count(&plain, "<Enumeration"), 0);
        assert_eq!(count(&plain, "declaredType"), 0);
        assert_eq!(count(&plain, "<Integer"), count(&description, "<Integer") + enumerations);
        assert!(plain.contains("Whether planets spin freely on their pins: 1 = free, 2 = imposed\""));
        assert_eq!(count(&plain, "<ScalarVariable"), count(&description, "<ScalarVariable"));
    }
}

//! The command `geometry`: checks the gears, makes every file in memory, and only then writes them.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, anyhow, bail};

use super::design::Design;
use super::{json, text};
use crate::places;

/// Facets per flank unless told otherwise.
const FACETS: usize = 32;
/// Fewest and most facets per flank: fewer show no involute, more make files that no CAD program wants.
const FACETS_RANGE: (usize, usize) = (2, 1000);

/// `geometry [--set NAME=VALUE]... [--facets N] [--out DIR]`.
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    /// What to set, each `name=value`.
    pub set: Vec<String>,
    /// Facets per flank, as written.
    pub facets: Option<String>,
    /// Where to put the files.
    pub out: Option<PathBuf>,
}

/// A file to be written.
pub struct Made {
    /// Its name within the folder.
    pub name: String,
    /// What stands in it.
    pub content: Vec<u8>,
}

impl Made {
    /// A file of text.
    pub fn text(name: impl Into<String>, content: String) -> Self {
        Self { name: name.into(), content: content.into_bytes() }
    }
}

impl Geometry {
    /// Does it.
    pub fn run(&self) -> Result<()> {
        let (design, facets) = match (Design::new(&self.set), self.facets()) {
            (Ok(design), Ok(facets)) => (design, facets),
            (Err(problem), Ok(_)) | (Ok(_), Err(problem)) => return Err(problem),
            (Err(problem), Err(other)) => bail!("{problem}\n{other}"),
        };
        let made = files(&design, facets)?;
        let folder = self.out.clone().unwrap_or_else(|| places::target().join("geometry"));
        fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
        for file in &made {
            let path = folder.join(&file.name);
            fs::write(&path, &file.content).with_context(|| format!("{} cannot be written", path.display()))?;
        }
        print!("{}\nfiles in {}\n{}", text::text(&design), places::shown(&folder), list(&made));
        Ok(())
    }

    fn facets(&self) -> Result<usize> {
        let Some(text) = &self.facets else { return Ok(FACETS) };
        let (least, most) = FACETS_RANGE;
        let number = text.parse().ok().filter(|number| (least..=most).contains(number));
        number.ok_or_else(|| anyhow!("--facets {text}: must be a whole number from {least} to {most}"))
    }
}

/// All files of `design`, with `facets` per flank where flanks are divided.
pub fn files(design: &Design, facets: usize) -> Result<Vec<Made>> {
    // flank curves, solids and scenes go here, each divided into `facets` per flank
    let _ = facets;
    Ok(vec![Made::text("dimensions.txt", text::text(design)), Made::text("dimensions.json", json::text(design)?)])
}

/// Names and sizes, a line each.
fn list(made: &[Made]) -> String {
    let width = made.iter().map(|file| file.name.len()).max().unwrap_or(0);
    made.iter().map(|file| format!("  {:<width$}  {:>7}\n", file.name, size(file.content.len()))).collect()
}

fn size(bytes: usize) -> String {
    match bytes {
        0..1_000 => format!("{bytes} B"),
        1_000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

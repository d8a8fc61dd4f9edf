//! The contact pattern: which spot of a flank sees which pressure while a pair of teeth goes through mesh.
//!
//! An assembler blues the teeth, turns the gears under load and looks where the ink is gone. Here teeth are solid
//! (`scene.gear_contact = solid`), every loaded section of planet 1's left mesh is followed over one whole engagement
//! ([`sample`]), mapped to the flank as it is and given its Hertz pressure; the largest that a spot ever sees is the
//! pattern ([`envelope`]). [`cases`] has the scenes, [`findings`] what they show in numbers; python/pattern.py draws.

pub mod cases;
pub mod envelope;
pub mod findings;
pub mod sample;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use crate::gears::scene::find;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script, sections};
use cases::Case;
use envelope::Envelope;
use findings::Findings;
use sample::Record;

/// Where the findings stand.
const DOCUMENT: &str = "docs/pattern.md";
const MARKS: [&str; 2] = ["<!-- pattern:begin -->", "<!-- pattern:end -->"];
/// Share of the bar that belongs to simulating.
const SIMULATING: f64 = 0.9;

/// The command `pattern [--scene FILE|NAME]... [--out DIR] [--write]`.
#[derive(Clone, Debug, Default)]
pub struct Pattern {
    /// Files or names of scenes; without any the cases of the documentation.
    pub scenes: Vec<String>,
    /// Where to put the files.
    pub out: Option<PathBuf>,
    /// Whether to renew the documents.
    pub write: bool,
}

impl Pattern {
    /// Does it.
    pub fn run(&self) -> Result<()> {
        anyhow::ensure!(
            !self.write || self.scenes.is_empty(),
            "--write renews the documents with their own cases: leave --scene out"
        );
        let cases: Vec<Case> = if self.scenes.is_empty() {
            cases::all()?
        } else {
            self.scenes.iter().map(|name| find(name).map(Case::of)).collect::<Result<_>>()?
        };
        let progress = Progress::start("looking for Python");
        let environment = Environment::ready(|what| progress.tell(what))?;
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("pattern"));
        fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
        progress.begin_bar("simulating");
        let (mut envelopes, mut contacts, mut found) = (Envelope::head(), Record::head(), Vec::new());
        let mut outline = envelope::outline_head();
        for (i, case) in cases.iter().enumerate() {
            progress.advance(SIMULATING * i as f64 / cases.len() as f64, &case.title);
            let record = Record::new(&case.scene)?;
            envelope::outline(&record.pair, &case.name, &mut outline);
            Envelope::new(&record).rows(&case.name, &mut envelopes);
            record.rows(&case.name, &mut contacts);
            found.push(Findings::new(case, &record)?);
        }
        let summary = findings::csv(&found);
        for (name, text) in [
            ("pattern.csv", &envelopes),
            ("contacts.csv", &contacts),
            ("summary.csv", &summary),
            ("outline.csv", &outline),
        ] {
            fs::write(folder.join(name), text).with_context(|| format!("{name} cannot be written"))?;
        }
        progress.advance(SIMULATING, "drawing");
        let drawing = paths::workspace().join("fmu-build").join("python").join("pattern.py");
        script::run(&environment, &drawing, &[&folder], &progress)?;
        progress.finish();
        print!("{}", findings::terminal(&found));
        println!("files: {}", paths::shown(&folder));
        if self.write {
            sections::renew(DOCUMENT, MARKS, &findings::markdown(&found))?;
            copy_pictures(&folder)?;
            println!("renewed: {DOCUMENT}, docs/figures");
        }
        Ok(())
    }
}

fn copy_pictures(folder: &Path) -> Result<()> {
    let figures = paths::workspace().join("docs").join("figures");
    for name in ["contact_pattern.png", "contact_lines.png"] {
        fs::copy(folder.join(name), figures.join(name)).with_context(|| format!("{name} cannot be copied"))?;
    }
    Ok(())
}

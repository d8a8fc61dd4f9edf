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
use clap::Args;

use crate::gears::scene::find;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script, sections};
use cases::PatternCase;
use envelope::Envelope;
use findings::PatternFindings;
use sample::Engagement;

/// The document or the marks of the findings.
const DOCUMENT: &str = "docs/pattern.md";
const MARKS: [&str; 2] = ["<!-- pattern:begin -->", "<!-- pattern:end -->"];
/// Share of the bar that belongs to simulating.
const SIMULATING: f64 = 0.9;

/// Shows the contact pattern of solid teeth: pressure on the planet's flank over one engagement
#[derive(Args, Clone, Debug)]
pub struct PatternCommand {
    /// A scene file or the name of a scene, repeatable [default: the aligned and misaligned cases of docs/pattern.md]
    #[arg(long = "scene", value_name = "FILE|NAME")]
    scenes: Vec<String>,
    /// Folder for figures and CSV [default: target/pattern]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Also renew docs/pattern.md and its figures
    #[arg(long, conflicts_with = "scenes")]
    write: bool,
}

impl PatternCommand {
    /// Simulates the cases and draws their patterns.
    pub fn run(&self) -> Result<()> {
        let cases: Vec<PatternCase> = if self.scenes.is_empty() {
            cases::all()?
        } else {
            self.scenes.iter().map(|name| find(name).map(PatternCase::of)).collect::<Result<_>>()?
        };
        let progress = Progress::start("looking for Python");
        let environment = Environment::ready(|what| progress.stage(what))?;
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("pattern"));
        paths::create_folder(&folder)?;
        progress.begin_bar("simulating");
        let (mut envelopes, mut contacts, mut found) = (Envelope::file()?, Engagement::file()?, Vec::new());
        let mut outline = envelope::outline_file()?;
        for (i, case) in cases.iter().enumerate() {
            progress.advance(SIMULATING * i as f64 / cases.len() as f64, &case.title);
            let record = Engagement::new(&case.scene)?;
            envelope::outline(&record.pair, &case.name, &mut outline)?;
            Envelope::new(&record).rows(&case.name, &mut envelopes)?;
            record.rows(&case.name, &mut contacts)?;
            found.push(PatternFindings::new(case, &record)?);
        }
        let summary = findings::csv(&found)?;
        for (name, text) in [
            ("pattern.csv", envelopes.text()?),
            ("contacts.csv", contacts.text()?),
            ("summary.csv", summary),
            ("outline.csv", outline.text()?),
        ] {
            fs::write(folder.join(name), text).with_context(|| format!("{name} cannot be written"))?;
        }
        progress.advance(SIMULATING, "drawing");
        let drawing = paths::workspace().join("fmu-build").join("python").join("pattern.py");
        script::run(&environment, &drawing, &[&folder], &progress)?;
        progress.finish();
        print!("{}", findings::table(&found).terminal());
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

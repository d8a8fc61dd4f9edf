//! What facets cost in accuracy and in time: solid teeth in the study's turn, compared with exact teeth.
//!
//! Solids of 4 to 128 facets a flank run together with teeth on the path of contact ([`run`]), with the deepest point nearly alone and
//! with the patch; errors, their orders in the number of facets, and times ([`measured`], [`errors`]) become a CSV file
//! each, figures by python/solids.py, docs/solids.md and a table in docs/study.md.

pub mod errors;
pub mod files;
pub mod findings;
pub mod results;
pub mod run;
pub mod tables;

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::tools::machine::machine;
use crate::tools::places;
use answers::text::table::{Table, for_terminal};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use fmu_build::tools::{paths, script, sections};
use results::{SolidsPlan, SolidsResults};
use run::Window;

const DOCUMENT: &str = "docs/solids.md";
const MARKS: [&str; 2] = ["<!-- solids:begin -->", "<!-- solids:end -->"];
/// The page about the study has the table of ripples.
const STUDY: &str = "docs/study.md";
const STUDY_MARKS: [&str; 2] = ["<!-- solids table begin -->", "<!-- solids table end -->"];
const PICTURES: [&str; 2] = ["solids_convergence.png", "solids_cycle.png"];

/// Facets, and how far from that of exact teeth their mean force may be, relative.
const BOUNDS: [(i32, f64); 2] = [(32, 1e-2), (128, 1e-3)];

/// From 0.14 s two mesh cycles of 0.18 s each are left.
const FULL: SolidsPlan = SolidsPlan {
    facets: &[4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128],
    window: Window { settled: 0.14, close: 0.32, end: 0.5 },
    runs: 5,
};

const QUICK: SolidsPlan =
    SolidsPlan { facets: &[4, 8, 16, 32], window: Window { settled: 0.02, close: 0.05, end: 0.1 }, runs: 5 };

/// Measures how the number of facets of solid teeth affects accuracy and time
///
/// Fails if solids miss the mean force of exact teeth.
#[derive(Args, Clone, Debug)]
pub struct SolidsCommand {
    /// Only 4 to 32 facets over 0.1 s
    #[arg(long, conflicts_with = "write")]
    quick: bool,
    /// Also renew docs/solids.md, the table in docs/study.md and the figures
    #[arg(long)]
    write: bool,
    /// Folder for figures and CSV [default: target/solids]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl SolidsCommand {
    /// Measures, draws and prints the tables.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let environment = Environment::ready(|what| progress.stage(what))?;
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("solids"));
        paths::create_folder(&folder)?;
        progress.begin_bar("measuring");
        let form = if self.quick { QUICK } else { FULL };
        let found = results::measure(form, &mut |done, what| progress.advance(0.95 * done, what))?;
        for (name, text) in [("solids.csv", files::errors(&found)?), ("solids_cycle.csv", files::cycle(&found)?)] {
            fs::write(folder.join(name), text).with_context(|| format!("{name} cannot be written"))?;
        }
        progress.advance(0.95, "drawing");
        let drawing = places::script("solids.py");
        script::run(&environment, &drawing, &[&folder], &progress)?;
        progress.finish();
        let page = page(&found);
        println!("{}\nfiles: {}", for_terminal(&page), paths::shown(&folder));
        verdict(&found)?;
        if self.write {
            sections::renew(DOCUMENT, MARKS, &page)?;
            let table = tables::spikes(&found).markdown();
            sections::renew(STUDY, STUDY_MARKS, &format!("{table}\n{}\n", findings::study(&found)))?;
            let figures = paths::workspace().join("docs").join("figures");
            for name in PICTURES {
                fs::copy(folder.join(name), figures.join(name)).with_context(|| format!("{name} cannot be copied"))?;
            }
            println!("renewed: {DOCUMENT}, {STUDY}, docs/figures");
        }
        Ok(())
    }
}

/// What is written into the document.
fn page(found: &SolidsResults) -> String {
    let part = |title: &str, table: Table| format!("{title}\n\n{}\n", table.markdown());
    [
        findings::page(found),
        part("Patch (`solid.smoothing` = 1): errors against exact teeth, and cost.", tables::errors(found, 1)),
        part("Deepest point nearly alone (`solid.smoothing` = 0.02): the same.", tables::errors(found, 0)),
        part("Orders observed between facet numbers, patch:", tables::orders(found, 1)),
        part("Orders observed between facet numbers, deepest point:", tables::orders(found, 0)),
        format!(
            "Last rows of the first two tables: exact teeth at 1e-6 against themselves at 1e-9. Measured on {}.\n",
            machine()
        ),
    ]
    .join("\n")
}

/// Whether solids come to exact teeth; whether they are faster than real time is only reported, as machines differ.
fn verdict(found: &SolidsResults) -> Result<()> {
    for (facets, bound) in BOUNDS {
        let Some(row) = found.solid(facets, 1) else { continue };
        let (mean, exact) = (row.look.mean, found.tooth().look.mean);
        let off = (mean / exact - 1.0).abs();
        println!(
            "{facets} facets: mean force {mean:.1} N, of exact teeth {exact:.1} N, {:.4} % off; {:.2} × real time",
            100.0 * off,
            row.real_time(&found.form)
        );
        ensure!(
            off <= bound,
            "{facets} facets miss the mean force by {:.3} %, more than {} %",
            100.0 * off,
            100.0 * bound
        );
    }
    Ok(())
}

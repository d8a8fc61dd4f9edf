//! The command `geometry`: checks the gears, makes every file in memory, and only then writes them.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, anyhow, bail};
use clap::Args;

use super::design::Design;
use super::geometry_file::GeometryFile;
use super::interference::InterferenceCheck;
use super::{json, models, text};
use crate::gears::scene::set::{real, value, variable};
use crate::tools::paths;
use crate::tools::progress::Progress;

/// Default of facets per flank.
const FACETS: usize = 32;
/// Fewest and most facets per flank: fewer show no involute, more make files that no CAD program wants.
const FACETS_RANGE: (usize, usize) = (2, 1000);

/// Calculates all dimensions of the gears, checks them for interference, and makes curves and solids for CAD
#[derive(Args, Clone, Debug, Default)]
pub struct GeometryCommand {
    /// Set a parameter of the gears, such as geometry.module=4mm
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Facets per flank of curves and solids [default: 32]
    #[arg(long, value_name = "N")]
    pub facets: Option<String>,
    /// Check for interference with teeth thicker by this length, such as 0.15mm
    #[arg(long, value_name = "LENGTH")]
    pub thicken: Option<String>,
    /// Folder for the files [default: target/geometry]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl GeometryCommand {
    /// Checks the gears, then writes the files.
    pub fn run(&self) -> Result<()> {
        let (design, facets, thicken) = match (Design::new(&self.set), self.facets(), self.thicken()) {
            (Ok(design), Ok(facets), Ok(thicken)) => (design, facets, thicken),
            (design, facets, thicken) => {
                let problems = [design.err(), facets.err(), thicken.err()].into_iter().flatten();
                bail!("{}", problems.map(|problem| problem.to_string()).collect::<Vec<_>>().join("\n"))
            }
        };
        let progress = Progress::start("turning the gears through a tooth pitch");
        let check = InterferenceCheck::new(&design, thicken)?;
        progress.stage("making curves and solids");
        let made = files(&design, &check, facets)?;
        progress.finish();
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("geometry"));
        paths::create_folder(&folder)?;
        for file in &made {
            let path = folder.join(&file.name);
            fs::write(&path, &file.content).with_context(|| format!("{} cannot be written", path.display()))?;
        }
        let (table, found) = (text::text(&design), check.text());
        print!("{table}\n{found}\nfiles in {}\n{}", paths::shown(&folder), list(&made));
        Ok(())
    }

    fn facets(&self) -> Result<usize> {
        let Some(text) = &self.facets else { return Ok(FACETS) };
        let (least, most) = FACETS_RANGE;
        let number = text.parse().ok().filter(|number| (least..=most).contains(number));
        number.ok_or_else(|| anyhow!("--facets {text}: must be a whole number from {least} to {most}"))
    }

    /// In metres, within the range that backlash has.
    fn thicken(&self) -> Result<f64> {
        let Some(text) = &self.thicken else { return Ok(0.0) };
        let number = variable("geometry.backlash").and_then(|row| real(row, &value(text)));
        number.map_err(|problem| anyhow!("--thicken {text}: {problem}"))
    }
}

/// All files of `design` and its `check`, with `facets` per flank where flanks are divided.
pub fn files(design: &Design, check: &InterferenceCheck, facets: usize) -> Result<Vec<GeometryFile>> {
    let mut made = vec![
        GeometryFile::text("dimensions.txt", text::text(design)),
        GeometryFile::text("dimensions.json", json::text(design, Some(check))?),
        GeometryFile::text("interference.txt", check.text()),
    ];
    made.extend(models::files(design, facets)?);
    Ok(made)
}

/// Names and sizes, a line each.
fn list(made: &[GeometryFile]) -> String {
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

//! The commands `scene` and `loads`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};

use super::run::Run;
use super::{find, list, loads, plan, run, units};
use crate::tools::paths;

/// `scene [FILE|NAME] [--run] [--csv OUT.csv]`.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// File or name; none lists the scenes.
    pub name: Option<String>,
    /// Whether to simulate it.
    pub run: bool,
    /// Where to record it; asks for a run too.
    pub csv: Option<PathBuf>,
}

/// `loads --scene FILE|NAME --out OUT.csv [--every TIME]`.
#[derive(Clone, Debug, Default)]
pub struct Loads {
    /// File or name.
    pub scene: Option<String>,
    /// File to write.
    pub out: Option<PathBuf>,
    /// Interval, with a unit of time.
    pub every: Option<String>,
}

impl Scene {
    /// Does it.
    pub fn run(&self) -> Result<()> {
        let Some(name) = &self.name else {
            if self.run || self.csv.is_some() {
                return Err(anyhow!("scene --run wants a scene:\n{}", list()?));
            }
            print!("{}", list()?);
            return Ok(());
        };
        let scene = find(name)?;
        print!("{}", plan::text(&scene, &Run::start(&scene, scene.step)?.simulation));
        if !self.run && self.csv.is_none() {
            return Ok(());
        }
        let mut file = self.csv.as_deref().map(create).transpose()?;
        let outcome = run::run(&scene, None, file.as_mut().map(|file| file as &mut dyn Write))?;
        print!("\n{}", outcome.text());
        if let (Some(mut file), Some(path)) = (file, &self.csv) {
            file.flush().with_context(|| format!("{} cannot be written", path.display()))?;
            println!("record: {}", paths::shown(path));
        }
        Ok(())
    }
}

impl Loads {
    /// Does it.
    pub fn run(&self) -> Result<()> {
        let wants = |what: &str| anyhow!("loads wants {what}: loads --scene NAME --out OUT.csv [--every TIME]");
        let scene = find(self.scene.as_deref().ok_or_else(|| wants("--scene"))?)?;
        let path = self.out.as_deref().ok_or_else(|| wants("--out"))?;
        let every = self.every.as_deref().map(units::seconds).transpose();
        let every = every.map_err(|problem| anyhow!("--every: {problem}"))?;
        let mut file = create(path)?;
        let lines = loads::write(&scene, every, &mut file)?;
        file.flush().with_context(|| format!("{} cannot be written", path.display()))?;
        println!("{}: {lines} loads of tooth pairs", paths::shown(path));
        Ok(())
    }
}

fn create(path: &Path) -> Result<BufWriter<File>> {
    Ok(BufWriter::new(File::create(path).with_context(|| format!("{} cannot be written", path.display()))?))
}

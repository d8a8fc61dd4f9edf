//! The commands `scene` and `loads`.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;

use super::run::SceneRun;
use super::{find, find_with, list, loads, plan, run, script, ssv, units};
use crate::tools::{paths, usage};

/// Describes a scene, or lists all scenes; simulates it, or writes it for other hosts of the FMU
#[derive(Args, Clone, Debug)]
pub struct SceneCommand {
    /// A scene file, or the name of a scene; without it, list the scenes
    #[arg(value_name = "FILE|NAME")]
    name: Option<String>,
    /// Simulate the scene and summarise its outputs
    #[arg(long)]
    run: bool,
    /// Simulate the scene and record its outputs at each communication point
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Change the scene, such as left.load_torque="400 N.m", scene.start=rest, stop_time="20 ms" (may be repeated)
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Write the start values as a parameter set of SSP 1.0, which hosts read into the FMU
    #[arg(long, value_name = "OUT.ssv")]
    ssv: Option<PathBuf>,
    /// Write a Python script that simulates the scene by the package bevel_differential, and records the same numbers as --csv
    #[arg(long, value_name = "OUT.py")]
    python: Option<PathBuf>,
}

/// Records the force on each loaded tooth pair of a scene, for FEA
#[derive(Args, Clone, Debug)]
pub struct LoadsCommand {
    /// A scene file, or the name of a scene
    #[arg(long, value_name = "FILE|NAME")]
    scene: String,
    /// The file to write
    #[arg(long, value_name = "OUT.csv")]
    out: PathBuf,
    /// Time between records, such as 0.1ms [default: the scene's communication step]
    #[arg(long, value_name = "TIME")]
    every: Option<String>,
}

impl SceneCommand {
    /// Describes, lists or simulates.
    pub fn run(&self) -> Result<()> {
        let Some(name) = &self.name else {
            if self.run || self.csv.is_some() || !self.set.is_empty() || self.ssv.is_some() || self.python.is_some() {
                bail!("--run, --csv, --set, --ssv and --python need a scene; name one of these:\n{}", list()?);
            }
            print!("{}", list()?);
            return Ok(());
        };
        let scene = find_with(name, &self.set).map_err(usage::of)?;
        print!("{}", plan::text(&scene, &SceneRun::start(&scene, scene.step)?.simulation));
        if let Some(path) = &self.ssv {
            write(path, &ssv::text(&scene)?)?;
            println!("parameter set: {}", paths::shown(path));
        }
        if let Some(path) = &self.python {
            write(path, &script::text(&scene)?)?;
            println!("script: {}", paths::shown(path));
        }
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

impl LoadsCommand {
    /// Simulates the scene and writes the file.
    pub fn run(&self) -> Result<()> {
        let scene = find(&self.scene).map_err(usage::of)?;
        let path = self.out.as_path();
        let every = self.every.as_deref().map(units::seconds).transpose();
        let every = every.map_err(|problem| usage::error(format!("--every: {problem}")))?;
        let mut file = create(path)?;
        let lines = loads::write(&scene, every, &mut file)?;
        file.flush().with_context(|| format!("{} cannot be written", path.display()))?;
        println!("{}: {lines} loads of tooth pairs", paths::shown(path));
        Ok(())
    }
}

fn write(path: &Path, text: &str) -> Result<()> {
    fs::write(path, text).with_context(|| format!("{} cannot be written", path.display()))
}

fn create(path: &Path) -> Result<BufWriter<File>> {
    Ok(BufWriter::new(File::create(path).with_context(|| format!("{} cannot be written", path.display()))?))
}

//! The wheel on a machine without Rust, checked by python/wheel.py.

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::tools::scripted::Script;
use fmu_build::tools::paths;

/// Installs the wheel in a fresh environment without Rust, and checks it there: examples, bits against fmpy, a sweep
#[derive(Args, Clone, Debug)]
pub struct TestWheelCommand {
    /// The wheel [default: the one that the command `wheel` built]
    wheel: Option<PathBuf>,
}

impl TestWheelCommand {
    /// Installs, checks, and prints a line for each check.
    pub fn run(&self) -> Result<()> {
        let wheel = match &self.wheel {
            Some(file) => file.clone(),
            None => last_built()?,
        };
        let wheel = wheel.canonicalize().with_context(|| format!("{} cannot be read", paths::shown(&wheel)))?;
        let given = vec![wheel.into(), paths::wheel().into()];
        Script::own("wheel.py", "making a fresh Python environment", None).run(|_| Ok(given)).map(|_| ())
    }
}

/// The wheel of this version.
fn last_built() -> Result<PathBuf> {
    let name = format!("bevel_differential-{}-py3-none-any.whl", env!("CARGO_PKG_VERSION"));
    let file = paths::wheel().join(name);
    ensure!(file.is_file(), "{} is not there; build it: cargo run --release -- wheel", paths::shown(&file));
    Ok(file)
}

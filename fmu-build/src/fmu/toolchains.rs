//! The tool chains for other machines, each in a separate folder of target/toolchains. None is required: packaging uses those
//! that are installed.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use bevel_differential::variables;
use clap::Args;

use crate::tools::paths;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;

/// The command that installs them, for hints.
pub const COMMAND: &str = "cargo run --release -- toolchains";

/// Oldest glibc that the library for Linux is linked for.
pub const GLIBC: &str = "2.17";

/// Rust's name of the Windows target that is built for.
pub const WINDOWS_TARGET: &str = "x86_64-pc-windows-gnu";

/// Installs the tool chains for old Linux systems and for Windows, with wine, in target/toolchains
///
/// They need Debian on x86-64, 400 MB to download and 2 GB on disk. Packaging uses them from then on.
#[derive(Args, Clone, Debug)]
pub struct ToolchainsCommand {
    /// Install only this one
    #[arg(value_parser = ["linux64", "win64"])]
    platform: Option<String>,
}

impl ToolchainsCommand {
    /// Installs what is missing and prints where it is.
    pub fn run(&self) -> Result<()> {
        run(self.platform.as_deref())
    }
}

fn run(platform: Option<&str>) -> Result<()> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        bail!("the tool chains are programs for Linux on x86-64; elsewhere the FMU holds this machine's library alone");
    }
    let wanted = |name| platform.is_none_or(|only| only == name);
    let progress = Progress::start("looking for Python");
    let mut made = Vec::new();
    if wanted("linux64") {
        let linux = Environment::for_old_linux(|what| progress.stage(what))?;
        made.push(format!("linux64 for glibc {GLIBC}: {}", paths::shown(&linux.programs())));
    }
    if wanted("win64") {
        let windows = WindowsToolchain::made(&progress)?;
        made.push(format!("win64, and wine:       {}", paths::shown(&windows.programs())));
    }
    progress.finish();
    println!("{}", made.join("\n"));
    Ok(())
}

/// Rust for Windows, a linker, and wine, unpacked from Debian's packages.
pub struct WindowsToolchain {
    folder: PathBuf,
}

impl WindowsToolchain {
    /// The tool chain, if the present script installed it.
    pub fn found() -> Option<Self> {
        let windows = Self { folder: paths::toolchains().join("windows") };
        let wanted = stamp().ok()?;
        fs::read_to_string(windows.stamp()).is_ok_and(|found| found == wanted).then_some(windows)
    }

    fn made(progress: &Progress) -> Result<Self> {
        if let Some(windows) = Self::found() {
            return Ok(windows);
        }
        let windows = Self { folder: paths::toolchains().join("windows") };
        progress.stage("unpacking Rust, MinGW and wine for Windows (280 MB to download)");
        let output = Command::new("bash")
            .arg(script())
            .arg(&windows.folder)
            .stdin(Stdio::null())
            .output()
            .context("bash, which unpacks the tool chain for Windows, cannot be run")?;
        if !output.status.success() {
            bail!(
                "the tool chain for Windows cannot be installed: {}",
                String::from_utf8_lossy(&output.stderr).trim_end()
            );
        }
        fs::write(windows.stamp(), stamp()?)?;
        Ok(windows)
    }

    fn stamp(&self) -> PathBuf {
        self.folder.join("stamp")
    }

    /// The folder with the programs to call: rustc, the linker, wine64.
    pub fn programs(&self) -> PathBuf {
        self.folder.join("bin")
    }

    /// The folder that the packages are unpacked to.
    pub fn root(&self) -> PathBuf {
        self.folder.join("root")
    }
}

/// The search path with `folder` before all others.
pub fn path_with(folder: &Path) -> Result<OsString> {
    let path = env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(folder.to_path_buf()).chain(env::split_paths(&path));
    env::join_paths(folders).with_context(|| format!("{} cannot be put into PATH", folder.display()))
}

fn script() -> PathBuf {
    paths::workspace().join("fmu-build").join("cross").join("windows.sh")
}

/// Changes with the script.
fn stamp() -> Result<String> {
    let script = fs::read(script()).context("fmu-build/cross/windows.sh cannot be read")?;
    Ok(format!("{:016x}\n", variables::fnv1a(script.into_iter())))
}

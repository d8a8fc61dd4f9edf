//! The wheel on a machine without Rust: a fresh environment, no variables of the project, the examples of the documents.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::tools::places;
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python;

/// All extras of the package.
const EXTRAS: &str = "[sweep,design,plot,report,cad]";
/// The pages whose examples must run.
const PAGES: [&str; 2] = ["README.md", "docs/python.md"];
/// Programs of Rust, which the environment must not find.
const RUST: [&str; 3] = ["cargo", "rustc", "rustup"];
/// Beginnings of the variables that stay, in capitals: what a download needs, and what every program on Windows needs.
const KEPT: [&str; 9] =
    ["PIP_", "HTTP_PROXY", "HTTPS_PROXY", "NO_PROXY", "SSL_CERT_", "REQUESTS_CA_BUNDLE", "SYSTEMROOT", "TEMP", "TMP"];

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
        let progress = Progress::start("making a fresh Python environment");
        let user = User::new()?;
        progress.stage("installing the wheel");
        user.install(&wheel)?;
        progress.stage("checking it");
        let report = user.check()?;
        progress.finish();
        println!("{}", paths::shown(&wheel));
        print!("{report}");
        Ok(())
    }
}

/// The wheel of this version.
fn last_built() -> Result<PathBuf> {
    let name = format!("bevel_differential-{}-py3-none-any.whl", env!("CARGO_PKG_VERSION"));
    let file = paths::wheel().join(name);
    ensure!(file.is_file(), "{} is not there; build it: cargo run --release -- wheel", paths::shown(&file));
    Ok(file)
}

/// Somebody who has Python and the wheel, and nothing of this project.
struct User {
    environment: PathBuf,
    home: PathBuf,
    path: OsString,
}

impl User {
    fn new() -> Result<Self> {
        let [environment, home] = ["venv", "home"].map(|name| paths::wheel().join(name));
        if home.exists() {
            fs::remove_dir_all(&home).with_context(|| format!("{} cannot be removed", paths::shown(&home)))?;
        }
        paths::create_folder(&home)?;
        let mut make = python::system()?;
        make.args(["-m", "venv", "--clear"]).arg(&environment);
        python::finish(&mut make, "the Python environment cannot be created")?;
        let path = path_without_rust()?;
        Ok(Self { environment, home, path })
    }

    fn install(&self, wheel: &Path) -> Result<()> {
        let mut wanted = wheel.as_os_str().to_owned();
        wanted.push(EXTRAS);
        let mut pip = self.command();
        pip.args(["-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check", "--constraint"])
            .arg(paths::workspace().join("fmu-build").join("python").join("requirements.txt"))
            .env("PIP_CACHE_DIR", paths::wheel().join("cache"))
            .arg(wanted);
        python::finish(&mut pip, "the wheel cannot be installed (check the network)")
    }

    fn check(&self) -> Result<String> {
        let pages = PAGES.map(|page| paths::workspace().join(page));
        let output = self
            .command()
            .arg(places::script("wheel_check.py"))
            .args(pages)
            .output()
            .context("the checks cannot be run")?;
        let report = String::from_utf8_lossy(&output.stdout).into_owned();
        if !output.status.success() {
            bail!("the wheel fails a check:\n{report}{}", String::from_utf8_lossy(&output.stderr).trim_end());
        }
        Ok(report)
    }

    /// The environment's Python, which sees no settings and files of anybody else.
    fn command(&self) -> Command {
        let inside = if cfg!(windows) { ["Scripts", "python.exe"] } else { ["bin", "python"] };
        let mut command = Command::new(inside.iter().fold(self.environment.clone(), |path, part| path.join(part)));
        command.env_clear().envs(env::vars_os().filter(|(name, _)| stays(&name.to_string_lossy())));
        command.env("PATH", &self.path).env("HOME", &self.home).env("USERPROFILE", &self.home).env("MPLBACKEND", "Agg");
        command.current_dir(&self.home).stdin(Stdio::null()).args(["-I", "-X", "utf8"]);
        command
    }
}

/// Whether the user has the variable `name` too.
fn stays(name: &str) -> bool {
    KEPT.iter().any(|kept| name.to_uppercase().starts_with(kept))
}

/// The search path but for the folders with Rust's programs.
fn path_without_rust() -> Result<OsString> {
    let path = env::var_os("PATH").unwrap_or_default();
    let has_rust = |folder: &PathBuf| {
        RUST.iter().any(|name| folder.join(name).with_extension(env::consts::EXE_EXTENSION).exists())
    };
    env::join_paths(env::split_paths(&path).filter(|folder| !has_rust(folder))).context("PATH cannot be set")
}

//! Test of the page in a browser: Chromium runs it as a reader does. Its results are compared with those of node and of
//! the native FMU.

use std::env;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::tools::script::environment;
use answers::text::table::Table;
use fmu_build::fmu::package;
use fmu_build::fmu::page::FILE;
use fmu_build::tools::lock::Lock;
use fmu_build::tools::paths;
use fmu_build::tools::program::Finding;
use fmu_build::tools::progress::Progress;

/// Environment variable for a Chromium that is not on the search path.
const CHROME: &str = "CHROME";
/// Folder of the tests, name of their Python environment, and its packages.
const ENVIRONMENT: [&str; 3] = ["tests/browser", "browser", "playwright, pytest, fmpy, numpy"];

/// Opens the page in Chromium and checks it there: scenes, controls, messages, links, pictures, the bits of the native FMU
///
/// First make the page, with the command `page`. The tests need node, and Chromium: `chromium` on the search path, or
/// the program that the environment variable CHROME names.
#[derive(Args, Clone, Debug)]
pub struct TestPageCommand {
    /// The page [default: the one that the command `page` built]
    page: Option<PathBuf>,
    /// Keep the screenshots in this folder
    #[arg(long, value_name = "DIR")]
    shots: Option<PathBuf>,
}

impl TestPageCommand {
    /// Runs the tests and prints a table of what was checked.
    pub fn run(&self) -> Result<()> {
        let page = match &self.page {
            Some(file) => file.clone(),
            None => paths::page().join(FILE),
        };
        ensure!(page.is_file(), "{} is not there; make it: cargo run --release -- page", paths::shown(&page));
        let node = program_file(OsStr::new("node"))
            .context("node is not installed: apt install nodejs (or see nodejs.org)")?;
        let chromium = chromium()?;
        let progress = Progress::start("looking for Python");
        let environment = environment(ENVIRONMENT, |what| progress.stage(what))?;
        progress.stage("packaging the FMU");
        let fmu = package::package()?;
        progress.stage("testing the page");
        let checked = paths::target().join("browser").join("checked.csv");
        let _alone = Lock::of(&paths::target().join("browser"))?;
        let mut pytest = environment.command();
        pytest
            .args(["-m", "pytest", "-p", "no:cacheprovider", "--color=no", "--tb=short", "--table"])
            .arg(&checked)
            .arg(paths::workspace().join(ENVIRONMENT[0]))
            .env("PAGE", page.canonicalize()?)
            .env("FMU", &fmu)
            .env("BEVEL_DIFFERENTIAL_FMU", &fmu)
            .env("NODE", node)
            .env("CHROMIUM", chromium);
        if let Some(folder) = &self.shots {
            paths::create_folder(folder)?;
            pytest.arg("--shots").arg(folder.canonicalize()?);
        }
        let output = pytest.output().context("pytest cannot be run")?;
        progress.finish();
        if !output.status.success() {
            let [report, errors] =
                [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
            return Err(Finding(format!("the page fails its tests:\n{report}{errors}")).into());
        }
        print!("{}", table(&checked)?.terminal());
        Ok(())
    }
}

/// Finds the file of Chromium.
fn chromium() -> Result<PathBuf> {
    if let Some(named) = env::var_os(CHROME).filter(|named| !named.is_empty()) {
        let shown = Path::new(&named).display().to_string();
        return program_file(&named)
            .with_context(|| format!("{CHROME} = {shown}: this program does not run; name a Chromium"));
    }
    program_file(OsStr::new("chromium"))
        .with_context(|| format!("Chromium is not installed: apt install chromium, or name one by {CHROME}"))
}

/// Finds the file of a runnable program, on the search path unless `name` is a path.
fn program_file(name: &OsStr) -> Option<PathBuf> {
    let folders = env::var_os("PATH").unwrap_or_default();
    let named = Path::new(name);
    let beside = env::split_paths(&folders).map(|folder| folder.join(named).with_extension(env::consts::EXE_EXTENSION));
    let mut candidates =
        std::iter::once(named.to_path_buf()).filter(|file| file.components().count() > 1).chain(beside);
    candidates.find(|file| file.is_file() && runs(file))
}

fn runs(program: &Path) -> bool {
    let quiet = Stdio::null;
    let status = Command::new(program).arg("--version").stdin(quiet()).stdout(quiet()).stderr(quiet()).status();
    status.is_ok_and(|status| status.success())
}

/// Table of the completed checks, from the file written by the tests.
fn table(file: &Path) -> Result<Table> {
    let text = fs::read(file).with_context(|| format!("{} cannot be read", paths::shown(file)))?;
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(&text[..]);
    let mut table = Table::new(["checked", "cases", "found", "time, s"]).left([0, 2]);
    for row in reader.deserialize() {
        let row: [String; 4] = row?;
        table.push(row);
    }
    Ok(table)
}

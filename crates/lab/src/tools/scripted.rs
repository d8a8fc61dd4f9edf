//! Scripts that measure or check: what they print is for the terminal and, where asked for, for a document with its pictures.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use answers::text::table::for_terminal;
use anyhow::{Context, Result};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use fmu_build::tools::{paths, script, sections};

use super::places::{self, Bench};

/// Where tables and pictures go.
pub struct Document {
    /// The document.
    pub file: &'static str,
    /// The marks around its tables.
    pub marks: [&'static str; 2],
    /// Its pictures, which the script draws in the folder of results.
    pub pictures: &'static [&'static str],
}

/// A script and what it needs.
pub struct Script {
    /// Its file.
    pub file: PathBuf,
    /// What it does, beside the bar.
    pub doing: &'static str,
    /// What it runs in.
    pub needs: Needs,
    /// The folder of its results, if it leaves any.
    pub folder: Option<PathBuf>,
}

/// Environments of scripts.
pub enum Needs {
    /// That of users' commands.
    Users,
    /// The same with the packages of the tests.
    Tests,
    /// That of a folder of scripts.
    Bench(&'static Bench),
}

impl Script {
    /// A script of the laboratory's own that runs in the environment of users' commands.
    pub fn own(name: &str, doing: &'static str, folder: Option<&Path>) -> Self {
        Self { file: places::script(name), doing, needs: Needs::Users, folder: folder.map(Path::to_owned) }
    }

    /// One that runs in the environment of `bench`; its results go to `folder`.
    pub fn of(bench: &'static Bench, file: PathBuf, doing: &'static str, folder: &Path) -> Self {
        Self { file, doing, needs: Needs::Bench(bench), folder: Some(folder.to_owned()) }
    }

    /// Runs it with the arguments that `prepare` returns, prints its tables and where its results are, and returns the tables.
    pub fn run(&self, prepare: impl FnOnce(&Progress) -> Result<Vec<OsString>>) -> Result<String> {
        let progress = Progress::start("looking for Python");
        let report = |what: &str| progress.stage(what);
        let environment = match self.needs {
            Needs::Users => Environment::ready(report)?,
            Needs::Tests => Environment::complete(report)?,
            Needs::Bench(bench) => bench.environment(report)?,
        };
        let arguments = prepare(&progress)?;
        self.folder.as_deref().map_or(Ok(()), paths::create_folder)?;
        progress.begin_bar(self.doing);
        let tables = script::run(&environment, &self.file, &arguments, &progress)?;
        progress.finish();
        print!("{}", for_terminal(&tables));
        if let Some(folder) = &self.folder {
            println!("\nresults: {}", paths::shown(folder));
        }
        Ok(tables)
    }
}

impl Document {
    /// Runs `script`, and renews the document with its tables if `write`.
    pub fn make(
        &self,
        script: &Script,
        write: bool,
        prepare: impl FnOnce(&Progress) -> Result<Vec<OsString>>,
    ) -> Result<()> {
        let tables = script.run(prepare)?;
        if write { self.renew(&tables, script.folder.as_deref()) } else { Ok(()) }
    }

    /// Renews the document with `tables` and the pictures in `folder`.
    pub fn renew(&self, tables: &str, folder: Option<&Path>) -> Result<()> {
        sections::renew(self.file, self.marks, tables)?;
        let figures = paths::workspace().join("docs").join("figures");
        for (picture, folder) in self.pictures.iter().zip(folder.into_iter().cycle()) {
            fs::copy(folder.join(picture), figures.join(picture))
                .with_context(|| format!("{picture} cannot be copied to docs/figures"))?;
        }
        let with_pictures = if self.pictures.is_empty() { "" } else { " and its pictures in docs/figures" };
        println!("renewed: {}{with_pictures}", self.file);
        Ok(())
    }
}

/// Arguments of a script, with `--quick` at the end if it is to be short.
pub fn arguments(given: impl IntoIterator<Item = impl Into<OsString>>, quick: bool) -> Vec<OsString> {
    given.into_iter().map(Into::into).chain(quick.then(|| "--quick".into())).collect()
}

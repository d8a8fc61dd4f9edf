//! Tables that a script prints, for the terminal and, where asked for, for a document with its pictures.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use answers::text::table::for_terminal;
use anyhow::{Context, Result};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use fmu_build::tools::{paths, script, sections};

/// Where tables and pictures go.
pub struct Document {
    /// The document.
    pub file: &'static str,
    /// The marks around its tables.
    pub marks: [&'static str; 2],
    /// Its pictures, which the script draws in the folder of results.
    pub pictures: &'static [&'static str],
}

impl Document {
    /// Runs `script`, prints its tables and where its results are, and renews the document if `write`.
    pub fn make(
        &self,
        progress: Progress,
        doing: &str,
        (environment, script, arguments): (&Environment, &Path, &[OsString]),
        results: &Path,
        write: bool,
    ) -> Result<()> {
        progress.begin_bar(doing);
        let tables = script::run(environment, script, arguments, &progress)?;
        progress.finish();
        print!("{}", for_terminal(&tables));
        println!("\nresults: {}", paths::shown(results));
        if !write {
            return Ok(());
        }
        sections::renew(self.file, self.marks, &tables)?;
        let figures = paths::workspace().join("docs").join("figures");
        for picture in self.pictures {
            fs::copy(results.join(picture), figures.join(picture))
                .with_context(|| format!("{picture} cannot be copied to docs/figures"))?;
        }
        let with_pictures = if self.pictures.is_empty() { "" } else { " and its pictures in docs/figures" };
        println!("renewed: {}{with_pictures}", self.file);
        Ok(())
    }
}

//! Whether answers of the command `accuracy` can be trusted: random scenes, three quantities each, at 1 and 5 %. The chosen
//! setting runs in the packaged FMU, started from the parameter set that the answer writes, and is compared with a reference
//! that the search did not use: the richest model by another method (Radau) at a tenth of the tolerance.

mod case;
mod draw;
mod shipped;
mod verdict;

use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::tools::places;
use case::Case;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use fmu_build::tools::{paths, script, sections};

/// The page with the results, and the marks around them.
const PAGE: &str = "docs/accuracy.md";
const RANDOM: [&str; 2] = ["<!-- survey:begin -->", "<!-- survey:end -->"];
const SHIPPED: [&str; 2] = ["<!-- shipped:begin -->", "<!-- shipped:end -->"];

/// Checks answers of `accuracy` on random scenes, in the FMU, against another method
#[derive(Args, Clone, Debug)]
pub struct SurveyCommand {
    /// Number of scenes
    #[arg(long, default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..))]
    scenes: u64,
    /// Seed of the scenes
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Answer for the shipped scenes instead, all outputs of each to 1 %, and say how long that takes
    #[arg(long)]
    shipped: bool,
    /// Also renew the section in docs/accuracy.md
    #[arg(long)]
    write: bool,
    /// Folder for the cases and the table of all [default: target/survey]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl SurveyCommand {
    /// Answers all questions, runs the FMU, and prints the table of misses.
    pub fn run(&self) -> Result<()> {
        if self.shipped { self.shipped() } else { self.random() }
    }

    fn shipped(&self) -> Result<()> {
        let progress = Progress::start("answering");
        progress.begin_bar("answering");
        let table = shipped::table(&progress)?;
        progress.finish();
        print!("{}", table.terminal());
        if self.write {
            sections::renew(PAGE, SHIPPED, &format!("{}\n", table.markdown()))?;
        }
        Ok(())
    }

    fn random(&self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let environment = Environment::ready(|what| progress.stage(what))?;
        let fmu = paths::fmu();
        if !fmu.is_file() {
            bail!("{} is not there: make it with cargo run --release -- package", paths::shown(&fmu));
        }
        let folder = self.out.clone().unwrap_or_else(|| paths::target().join("survey"));
        if folder.exists() {
            fs::remove_dir_all(&folder).with_context(|| format!("{} cannot be emptied", paths::shown(&folder)))?;
        }
        paths::create_folder(&folder)?;
        progress.begin_bar("answering");
        let (cases, failed) = self.cases(&progress);
        for case in &cases {
            case.write(&folder)?;
        }
        progress.begin_bar("running the FMU");
        let runs = places::script("survey.py");
        script::run(&environment, &runs, &[&fmu, &folder], &progress)?;
        progress.finish();
        let found = cases.iter().map(|case| case.judge(&folder)).collect::<Result<Vec<_>>>()?;
        let file = verdict::write(&found, &folder)?;
        let text = verdict::text(&found, &failed);
        print!("{text}");
        if self.write {
            sections::renew(PAGE, RANDOM, &format!("\n```text\n{}\n```\n\n", text.trim_end()))?;
        }
        println!("all cases: {}", paths::shown(&file));
        Ok(())
    }

    /// All cases, and scenes that cannot be asked.
    fn cases(&self, progress: &Progress) -> (Vec<Case>, Vec<String>) {
        let next = AtomicUsize::new(0);
        let work = || {
            let (mut cases, mut failed) = (Vec::new(), Vec::new());
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed) as u64;
                if index >= self.scenes {
                    return (cases, failed);
                }
                progress.advance(index as f64 / self.scenes as f64, &format!("scene {} of {}", index + 1, self.scenes));
                match Case::all_of(self.seed, index) {
                    Ok(found) => cases.extend(found),
                    Err(why) => failed.push(format!("scene {index}: {why:#}")),
                }
            }
        };
        let workers = thread::available_parallelism().map_or(1, usize::from);
        let all: Vec<_> = thread::scope(|scope| {
            let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
            threads.into_iter().filter_map(|thread| thread.join().ok()).collect()
        });
        let (mut cases, mut failed) = (Vec::new(), Vec::new());
        for (some, wrong) in all {
            cases.extend(some);
            failed.extend(wrong);
        }
        cases.sort_by_key(|case| case.name.clone());
        failed.sort();
        (cases, failed)
    }
}

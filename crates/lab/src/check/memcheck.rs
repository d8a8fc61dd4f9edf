//! Check for memory errors and leaks: a host in C that uses instances from creation to end, random calls, and random
//! questions run under memcheck.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};
use bevel_differential::numeric::lanes;
use bevel_differential::variables::{guid, index_of};
use clap::Args;

use crate::check::fuzz::{self, Tally};
use answers::text::table::Table;
use fmu_build::fmu::libraries::own;
use fmu_build::tools::paths;
use fmu_build::tools::program::Finding;
use fmu_build::tools::progress::Progress;

/// Number of rounds of random calls, half of them for each version of FMI.
const ROUNDS: usize = 20;
/// Longest processor time of a random call. A few calls are steps of very stiff scenes, and need more time than all other
/// calls together.
const LONGEST: Duration = Duration::from_millis(200);

/// Value reference of `name`, as an argument.
pub fn reference(name: &str) -> Result<OsString> {
    index_of(name).map(|i| i.to_string().into()).with_context(|| format!("there is no variable {name}"))
}

/// Arguments of hosts in C: library, GUID, value references of an input and of an output.
pub fn arguments(library: &Path) -> Result<Vec<OsString>> {
    Ok(vec![library.into(), guid().into(), reference("left.load_torque")?, reference("left.speed")?])
}

/// Compiles tests/c/`name`.c with `options` and returns the program.
pub fn compiled(name: &str, options: &[&str]) -> Result<PathBuf> {
    let folder = paths::target().join("memory");
    paths::create_folder(&folder)?;
    // tests compile concurrently: each uses a separate file
    let program = folder.join(format!("{name}-{}", std::process::id()));
    let output = Command::new("cc")
        .args(["-std=gnu11", "-O1", "-g", "-Wall", "-Wextra", "-Werror"])
        .args(options)
        .arg("-o")
        .arg(&program)
        .arg(paths::workspace().join("tests/c").join(format!("{name}.c")))
        .args(["-ldl", "-lm"])
        .output()
        .context("a C compiler builds the hosts: install one (apt-get install gcc)")?;
    ensure!(output.status.success(), "{name}.c: {}", String::from_utf8_lossy(&output.stderr));
    Ok(program)
}

/// Checks a host in C, random calls and random questions for memory errors and leaks (needs valgrind and cc)
#[derive(Args, Clone, Debug)]
pub struct MemcheckCommand {
    /// Number of random questions
    #[arg(long, default_value_t = 200)]
    questions: usize,
}

impl MemcheckCommand {
    /// Runs everything under memcheck and prints a table. Fails if there is an error or a leak.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("building the library and the host");
        let life = compiled("life", &[])?;
        let host_arguments = arguments(&own::beside_program()?)?;
        let this = env::current_exe().context("the path of this program is unknown")?;
        progress.stage("looking for calls that take no time");
        let (calls, seed) = ((ROUNDS * fuzz::CALLS).to_string(), seed_of_quick_rounds()?.to_string());
        let rounds = ["fuzz", "--worker", "--calls", &calls, "--seed", &seed].map(OsString::from);
        let questions = ["questions", "--threads", "1", "--count", &self.questions.to_string()].map(OsString::from);
        let mut table = Table::new(["program", "checker", "errors", "bytes lost", "time, s"]).left([0, 1]);
        for (name, program, arguments) in [
            ("life of instances, in C", &life, &host_arguments[..]),
            ("calls at random", &this, &rounds),
            ("questions at random", &this, &questions),
        ] {
            progress.stage(&format!("memcheck on {name}"));
            table.push(memcheck(name, program, arguments)?);
        }
        fs::remove_file(&life).context("the host cannot be removed")?;
        progress.finish();
        print!("{}", table.terminal());
        Ok(())
    }
}

/// Returns the first seed of [`ROUNDS`] successive rounds in which every call takes at most [`LONGEST`] without memcheck.
fn seed_of_quick_rounds() -> Result<u64> {
    let mut first = 1;
    let mut seed = first;
    while seed < first + ROUNDS as u64 {
        let mut tally = Tally::default();
        if let Err(broken) = fuzz::run(fuzz::version(seed, None), seed, fuzz::CALLS, &mut tally) {
            return Err(Finding(format!("{broken:?}\nagain: {}", fuzz::again(seed, None))).into());
        }
        seed += 1;
        if tally.longest() > LONGEST {
            first = seed;
        }
    }
    Ok(first)
}

/// Runs a program under memcheck and returns its row of the table.
fn memcheck(program: &str, path: &Path, arguments: &[OsString]) -> Result<[String; 5]> {
    let start = Instant::now();
    let output = Command::new("valgrind")
        .args(["--leak-check=full", "--error-exitcode=99", "--errors-for-leak-kinds=definite,indirect,possible"])
        .args(["--show-leak-kinds=definite,indirect,possible", "--num-callers=30"])
        .arg(path)
        .args(arguments)
        // valgrind may not support all instructions on wider vectors
        .env(lanes::VARIABLE, "narrow")
        .output()
        .context("valgrind checks the memory: install it (apt-get install valgrind)")?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        let names = "to see names of functions, build and run again with CARGO_PROFILE_RELEASE_STRIP=none";
        return Err(Finding(format!("{program} ({}):\n{}\n{names}", output.status, said.trim_end())).into());
    }
    let errors = between(&said, "ERROR SUMMARY: ", " errors").context("valgrind reported no count of errors")?;
    let lost = between(&said, "definitely lost: ", " bytes").unwrap_or("0");
    let seconds = format!("{:.1}", start.elapsed().as_secs_f64());
    Ok([program, "memcheck", errors, lost, &seconds].map(str::to_owned))
}

/// Part of `said` between the texts `before` and `after`.
fn between<'a>(said: &'a str, before: &str, after: &str) -> Option<&'a str> {
    said.split_once(before)?.1.split_once(after).map(|(text, _)| text)
}

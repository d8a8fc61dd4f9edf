//! The C functions of FMI 2.0 and 3.0 called at random, in any order, with arguments right and wrong, on several instances of both
//! kinds; every result is checked against what the FMU promises.
//!
//! Rounds are independent: the round with the seed S is what `fuzz --seed S --calls 500` runs. Even seeds are rounds of FMI 2.0, odd ones
//! of FMI 3.0. Workers are separate processes of this program, started by python/fuzz.py, so that a crash or a hang is reported with
//! its seed.
//!
//! `fmi2` and `fmi3` are tables of functions, `calls` and `states` call them by their shapes at a `site`, and `round` has the promises.

mod arguments;
mod calls;
mod choice;
mod fmi2;
mod fmi3;
mod host;
mod instance;
mod interface;
mod random;
mod round;
mod scenes;
mod site;
mod states;
mod tally;
mod version;

pub use choice::{VERSIONS, version};
pub use round::{BrokenPromise, CALLS, run};
pub use tally::Tally;

use std::env;

use anyhow::{Context, Result};
use clap::Args;
use fmu_build::command_line::LABORATORY;
use fmu_build::tools::program::Finding;

use crate::tools::script::{DEFAULTS, Script};

/// Number of calls by default.
const MANY: usize = 1_000_000;

/// Calls the C functions at random and checks each result against what the FMU promises
#[derive(Args, Clone, Copy, Debug)]
pub struct FuzzCommand {
    /// Number of calls
    #[arg(long, value_name = "N", default_value_t = MANY)]
    calls: usize,
    /// Seed of the first round; each further round has the next
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Version of FMI: 2 or 3 [default: both by turns of seeds]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=3))]
    fmi: Option<u32>,
    /// Run rounds one after the other in this process and report them on standard output
    #[arg(long = "worker", hide = true)]
    is_worker: bool,
}

impl FuzzCommand {
    /// Calls at random and prints the table; fails with the seed if a promise is not kept.
    pub fn run(&self) -> Result<()> {
        if self.is_worker {
            return work(self);
        }
        let program = env::current_exe().context("the path of this program is unknown")?;
        let numbers = [self.calls.div_ceil(CALLS) as u64, CALLS as u64, self.seed].map(|number| number.to_string());
        let words = [program.into()].into_iter().chain(numbers.map(Into::into)).chain([LABORATORY.into()]);
        let words = words.chain(self.fmi.map(|number| number.to_string().into()));
        let script = Script { file: "crates/lab/python/fuzz.py", doing: "calling", ..DEFAULTS };
        script.follow(None, |_| Ok(words.collect())).map(drop)
    }
}

/// Works off rounds, and reports each before it begins, so that a crash can be reproduced.
fn work(command: &FuzzCommand) -> Result<()> {
    let mut tally = Tally::default();
    for k in 0..command.calls.div_ceil(CALLS) {
        let seed = command.seed.wrapping_add(k as u64);
        println!("round {seed}");
        let version = version(seed, command.fmi);
        if let Err(broken) = round::run(version, seed, CALLS, &mut tally) {
            let again = again(seed, command.fmi);
            let found = format!("call {}, {}: {}\nagain: {again}", broken.at, broken.function, broken.what);
            return Err(Finding(found).into());
        }
    }
    println!("{}", tally.json());
    Ok(())
}

/// Command that runs the round of `seed` again.
pub fn again(seed: u64, fmi: Option<u32>) -> String {
    let fmi = fmi.map_or_else(String::new, |number| format!(" --fmi {number}"));
    format!("{LABORATORY} fuzz --seed {seed} --calls {CALLS}{fmi}")
}

//! Random calls of the C functions of FMI 2.0 and 3.0: in any order, with valid and invalid arguments, on several
//! instances of both kinds. Every result is checked against the promises of the FMU: numbers are finite, each refusal is
//! logged, a refused call leaves the state unchanged, and a reset instance behaves like a new one.
//!
//! Rounds are independent: `fuzz --seed S --calls 500` repeats the round with the seed S. Without `--fmi`, even seeds are
//! rounds of FMI 2.0 and odd seeds are rounds of FMI 3.0. Workers are separate processes of this program, started by python/fuzz.py. A crash or a
//! hang can therefore be reported with its seed.
//!
//! The modules `fmi2` and `fmi3` contain tables of functions, each with its random call. `calls` and `states` contain
//! these calls, one for each signature. `site` contains the instance and the arguments of a call. `round` makes the
//! calls and checks the promises.

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

/// Default number of calls.
const MANY: usize = 1_000_000;

/// Calls the C functions at random and checks each result against the promises of the FMU
#[derive(Args, Clone, Copy, Debug)]
pub struct FuzzCommand {
    /// Number of calls
    #[arg(long, value_name = "N", default_value_t = MANY)]
    calls: usize,
    /// Seed of the first round; it rises by 1 from round to round
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Version of FMI: 2 or 3 [default: alternating with the seed]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=3))]
    fmi: Option<u32>,
    /// Run rounds sequentially in this process and report them on standard output
    #[arg(long = "worker", hide = true)]
    is_worker: bool,
}

impl FuzzCommand {
    /// Runs the calls and prints the table. Fails with the seed if a promise is broken.
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

/// Executes rounds and reports each one before it begins, so that a crash can be reproduced.
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

/// Command that repeats the round of `seed`.
pub fn again(seed: u64, fmi: Option<u32>) -> String {
    let fmi = fmi.map_or_else(String::new, |number| format!(" --fmi {number}"));
    format!("{LABORATORY} fuzz --seed {seed} --calls {CALLS}{fmi}")
}

//! The C functions called at random, in any order, with arguments right and wrong, on several instances of both kinds;
//! every result is checked against what the FMU promises.
//!
//! Rounds are independent: the round with the seed S is what `fuzz --seed S --calls 500` runs. Workers are separate
//! processes of this program, started by python/fuzz.py, so that a crash or a hang is reported with its seed.

mod arguments;
mod calls;
mod functions;
mod instance;
mod random;
mod round;
mod scenes;
mod states;
mod tally;

pub use functions::Function;
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
    /// Run rounds one after the other in this process and report them on standard output
    #[arg(long = "worker", hide = true)]
    is_worker: bool,
}

impl FuzzCommand {
    /// Calls at random and prints the table; fails with the seed if a promise is not kept.
    pub fn run(&self) -> Result<()> {
        if self.is_worker {
            return work(self.seed, self.calls);
        }
        let program = env::current_exe().context("the path of this program is unknown")?;
        let numbers = [self.calls.div_ceil(CALLS) as u64, CALLS as u64, self.seed].map(|number| number.to_string());
        let words = [program.into()].into_iter().chain(numbers.map(Into::into)).chain([LABORATORY.into()]);
        let script = Script { file: "crates/lab/python/fuzz.py", doing: "calling", ..DEFAULTS };
        script.follow(None, |_| Ok(words.collect())).map(drop)
    }
}

/// Works off rounds from `seed` on, and reports each before it begins, so that a crash can be reproduced.
fn work(seed: u64, calls: usize) -> Result<()> {
    let mut tally = Tally::default();
    for k in 0..calls.div_ceil(CALLS) {
        let seed = seed.wrapping_add(k as u64);
        println!("round {seed}");
        if let Err(broken) = round::run(seed, CALLS, &mut tally) {
            let found = format!("call {}, {}: {}\nagain: {}", broken.at, broken.function, broken.what, again(seed));
            return Err(Finding(found).into());
        }
    }
    println!("{}", tally.json());
    Ok(())
}

/// How to run the round of `seed` again.
pub fn again(seed: u64) -> String {
    format!("{LABORATORY} fuzz --seed {seed} --calls {CALLS}")
}

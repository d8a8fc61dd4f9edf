//! Random calls of the C functions of FMI 2.0 and 3.0: in any order, with valid and invalid arguments, on several
//! instances of both kinds. Every result is checked against the promises of the FMU: numbers are finite, each refusal is
//! logged, a refused call leaves the state unchanged, and a reset instance behaves like a new one.
//!
//! Rounds are independent. Without `--fmi`, even seeds are rounds of FMI 2.0 and odd seeds are rounds of FMI 3.0. Workers
//! are separate processes of this program, started by python/fuzz.py. A crash or a hang can therefore be reported with
//! its seed.
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
pub use round::{BrokenPromise, run};
pub use tally::Tally;

use anyhow::Result;
use clap::Args;
use fmu_build::tools::program::Finding;

/// Runs rounds of random calls and prints their seeds, and then the counts as JSON
#[derive(Args, Clone, Copy, Debug)]
pub struct FuzzCommand {
    /// Number of rounds
    #[arg(long)]
    rounds: u64,
    /// Number of calls of a round
    #[arg(long)]
    calls: usize,
    /// Seed of the first round; it rises by 1 from round to round
    #[arg(long)]
    seed: u64,
    /// Version of FMI: 2 or 3 [default: alternating with the seed]
    #[arg(long)]
    fmi: Option<u32>,
}

impl FuzzCommand {
    /// Executes rounds and reports each one before it begins, so that a crash can be reproduced. Fails if a promise is
    /// broken.
    pub fn run(&self) -> Result<()> {
        let mut tally = Tally::default();
        for k in 0..self.rounds {
            let seed = self.seed.wrapping_add(k);
            println!("round {seed}");
            if let Err(broken) = run(version(seed, self.fmi), seed, self.calls, &mut tally) {
                return Err(Finding(format!("call {}, {}: {}", broken.at, broken.function, broken.what)).into());
            }
        }
        println!("{}", tally.json());
        Ok(())
    }
}

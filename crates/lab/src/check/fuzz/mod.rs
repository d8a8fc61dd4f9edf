//! The C functions called at random, in any order, with arguments right and wrong, on several instances of both kinds;
//! every result is checked against what the FMU promises.
//!
//! Rounds are independent: the round with the seed S is what `fuzz --seed S --calls 500` runs. Workers are separate
//! processes, so that a crash or a hang is reported with its seed.

mod arguments;
mod call_result;
mod calls;
mod functions;
mod random;
mod round;
mod scenes;
mod states;
mod tally;
mod unit;
mod worker;

pub use functions::Function;
pub use round::{BrokenPromise, CALLS, run};
pub use tally::Tally;

use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use clap::Args;
use fmu_build::command_line::LABORATORY;

use fmu_build::tools::progress::Progress;

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
    pub fn run(self) -> Result<()> {
        if self.is_worker {
            return worker::work(self.seed, self.calls);
        }
        let progress = Progress::start("starting");
        progress.begin_bar("calling");
        let rounds = self.calls.div_ceil(CALLS);
        let crew = thread::available_parallelism().map_or(1, usize::from).min(rounds.max(1));
        let start = Instant::now();
        let mut parts = Vec::new();
        let mut first = self.seed;
        for k in 0..crew {
            let share = rounds / crew + usize::from(k < rounds % crew);
            parts.push(worker::Worker::start(first, share * CALLS)?);
            first = first.wrapping_add(share as u64);
        }
        loop {
            let done: usize = parts.iter_mut().map(worker::Worker::done).sum();
            let left = parts.iter().filter(|part| !part.is_over()).count();
            progress.advance(done as f64 / rounds.max(1) as f64, &format!("{} calls", done * CALLS));
            if left == 0 {
                break;
            }
            if parts.iter().any(worker::Worker::has_failed) {
                parts.iter_mut().for_each(worker::Worker::stop);
            }
            thread::sleep(Duration::from_millis(200));
        }
        progress.finish();
        let (mut tally, mut failures) = (Tally::default(), Vec::new());
        for part in parts {
            match part.end() {
                Ok(Some(part)) => tally.add(&part),
                Ok(None) => {}
                Err(failure) => failures.push(failure.to_string()),
            }
        }
        if !failures.is_empty() {
            bail!("{}", failures.join("\n\n"));
        }
        print!("{}", tally.table());
        println!("every promise kept in {} rounds, {:.0} s", rounds, start.elapsed().as_secs_f64());
        Ok(())
    }
}

/// How to run the round of `seed` again.
pub fn again(seed: u64) -> String {
    format!("{LABORATORY} fuzz --seed {seed} --calls {CALLS}")
}

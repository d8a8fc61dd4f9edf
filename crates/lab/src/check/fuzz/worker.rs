//! Rounds in a separate process: it reports each round before it begins, so that a crash can be reproduced.

use std::env;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow, bail};

use super::again;
use super::round::{self, CALLS};
use super::tally::Tally;

/// A round takes some seconds, half a minute at most, and a busy machine some times that; one that takes so long hangs.
const PATIENCE: Duration = Duration::from_secs(600);

/// Works off rounds from `seed` on: the worker's side.
pub fn work(seed: u64, calls: usize) -> Result<()> {
    let mut tally = Tally::default();
    for k in 0..calls.div_ceil(CALLS) {
        let seed = seed.wrapping_add(k as u64);
        println!("round {seed}");
        if let Err(broken) = round::run(seed, CALLS, &mut tally) {
            bail!("call {}, {}: {}\nagain: {}", broken.at, broken.function, broken.what, again(seed));
        }
    }
    println!("done");
    print!("{}", tally.lines());
    Ok(())
}

/// A worker, seen from the process that started it.
pub struct Worker {
    child: Child,
    lines: Receiver<String>,
    round: Option<u64>,
    rounds: usize,
    since: Instant,
    /// Lines after "done"; none as long as rounds are worked off.
    counts: Option<String>,
    is_over: bool,
    hangs: bool,
    /// Whether it was ended because another failed.
    is_stopped: bool,
}

impl Worker {
    /// Starts one on `calls` calls from `seed` on.
    pub fn start(seed: u64, calls: usize) -> Result<Self> {
        let mut child = Command::new(env::current_exe().context("the path of this program is unknown")?)
            .args(["fuzz", "--worker", "--seed", &seed.to_string(), "--calls", &calls.to_string()])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .context("a worker cannot be started")?;
        let pipe = child.stdout.take().context("a worker has no output")?;
        let (send, lines) = channel();
        thread::spawn(move || BufReader::new(pipe).lines().map_while(Result::ok).try_for_each(|line| send.send(line)));
        let since = Instant::now();
        Ok(Self {
            child,
            lines,
            round: None,
            rounds: 0,
            since,
            counts: None,
            is_over: false,
            hangs: false,
            is_stopped: false,
        })
    }

    /// Rounds that were begun and are over.
    pub fn done(&mut self) -> usize {
        loop {
            match self.lines.try_recv() {
                Ok(line) => self.hear(&line),
                Err(TryRecvError::Empty) if self.since.elapsed() > PATIENCE => {
                    self.hangs = true;
                    // it may have ended meanwhile
                    let _ = self.child.kill();
                    break;
                }
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => {
                    self.is_over = true;
                    break;
                }
            }
        }
        if self.counts.is_some() { self.rounds } else { self.rounds.saturating_sub(1) }
    }

    fn hear(&mut self, line: &str) {
        self.since = Instant::now();
        match (&mut self.counts, line.strip_prefix("round ")) {
            (Some(counts), _) => {
                counts.push_str(line);
                counts.push('\n');
            }
            (None, Some(seed)) => {
                self.round = seed.parse().ok();
                self.rounds += 1;
            }
            (None, None) => self.counts = Some(String::new()),
        }
    }

    /// Whether its output has ended.
    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// Whether it ended before its rounds were done.
    pub fn has_failed(&self) -> bool {
        self.is_over && self.counts.is_none()
    }

    /// Ends it, unless it has ended.
    pub fn stop(&mut self) {
        if !self.is_over && !self.is_stopped {
            self.is_stopped = self.child.kill().is_ok();
        }
    }

    /// What it counted, or how it ended; nothing if it was stopped.
    pub fn end(self) -> Result<Option<Tally>> {
        let again = self.round.map_or_else(String::new, again);
        let output = self.child.wait_with_output().context("a worker was lost")?;
        if self.is_stopped {
            return Ok(None);
        }
        if self.hangs {
            bail!("a round took more than {} s\nagain: {again}", PATIENCE.as_secs());
        }
        if !output.status.success() {
            let messages = String::from_utf8_lossy(&output.stderr);
            let crash = output.status.code().is_none();
            let what = if crash { format!("crashed ({})\nagain: {again}\n", output.status) } else { String::new() };
            return Err(anyhow!("{what}{}", messages.trim_end().trim_start_matches("error: ")));
        }
        self.counts.as_deref().and_then(Tally::read).context("a worker reported no counts").map(Some)
    }
}

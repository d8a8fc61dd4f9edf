//! Questions to the library of answers, through its C interface and from several threads at the same time. The command
//! `questions` of `crates/lab/lab.py` writes the questions and judges the replies.

use std::ffi::CString;
use std::fs;
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};

use answers::ask::c::as_in_c;
use anyhow::Result;
use clap::Args;
use fmu_build::tools::program::Finding;
use serde_json::{Value, json};

/// Time after which the caller stops the work.
const PATIENCE: Duration = Duration::from_millis(20);

/// Maximum number of characters of a reply that is printed.
const LONGEST: usize = 400;

/// Asks the questions of a file and prints the index of each, the kind of its reply, the seconds, and an unexpected reply
#[derive(Args, Clone, Debug)]
pub struct QuestionsCommand {
    /// File with a question and its numbers on each line, as JSON; numbers are texts
    file: PathBuf,
    /// Number of threads
    threads: usize,
}

impl QuestionsCommand {
    /// Runs the command. Fails if a thread has panicked.
    pub fn run(&self) -> Result<()> {
        let text = fs::read_to_string(&self.file)?;
        let mut shares = vec![Vec::new(); self.threads.max(1)];
        for (index, line) in text.lines().enumerate() {
            let (question, numbers): (String, Vec<String>) = serde_json::from_str(line)?;
            let numbers = numbers.iter().map(|number| number.parse()).collect::<Result<Vec<f64>, _>>()?;
            shares[index % self.threads.max(1)].push((index, CString::new(question)?, numbers));
        }
        // without `thread::scope`, which keeps a handle of the main thread that memcheck would report as a leak
        let spawned = shares.into_iter().map(|share| thread::spawn(move || share.iter().for_each(ask)));
        let threads: Vec<_> = spawned.collect();
        let lost = threads.into_iter().filter_map(|thread| thread.join().err()).count();
        if lost > 0 { Err(Finding(format!("{lost} threads were lost")).into()) } else { Ok(()) }
    }
}

fn ask((index, question, numbers): &(usize, CString, Vec<f64>)) {
    let begin = Instant::now();
    let reply = as_in_c(question, numbers, || begin.elapsed() < PATIENCE);
    let (seconds, kind) = (begin.elapsed().as_secs_f64(), kind(&reply));
    let is_finding = kind.as_ref().is_none_or(|kind| kind == "internal");
    let shown: String = reply.chars().take(if is_finding { LONGEST } else { 0 }).collect();
    println!("{}", json!([index, kind, seconds, shown]));
}

/// Kind of a reply. `None` if the reply contains neither an answer nor a kind with problems that all have messages.
fn kind(reply: &str) -> Option<String> {
    let value: Value = serde_json::from_str(reply).ok()?;
    if value.get("answer").is_some_and(Value::is_object) {
        return Some("answer".into());
    }
    let problems = value["problems"].as_array().filter(|problems| !problems.is_empty())?;
    let have_messages =
        problems.iter().all(|problem| problem["message"].as_str().is_some_and(|message| !message.is_empty()));
    value["kind"].as_str().filter(|_| have_messages).map(str::to_owned)
}

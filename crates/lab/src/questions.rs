//! Random questions to the library of answers, through its C interface and from several threads at the same time. Each
//! question must get an answer or a problem.

use std::collections::BTreeMap;
use std::ffi::CString;
use std::thread;
use std::time::{Duration, Instant};

use answers::ask::c::as_in_c;
use answers::text::table::Table;
use anyhow::Result;
use bevel_differential::variables::table;
use clap::Args;
use fastrand::Rng;
use fmu_build::tools::paths;
use fmu_build::tools::program::Finding;
use fmu_build::tools::progress::Progress;
use serde_json::{Map, Value, json};

use crate::random::Draws;

/// Time after which the caller stops the work.
const PATIENCE: Duration = Duration::from_millis(20);
/// Absurd numbers and texts.
const ODD: [&str; 14] =
    ["0", "-1", "1e308", "-1e-320", "1e999", "nan", "inf", "", "°", "4.5 mm", "3 kg", "true", "line_weber", "a\u{0}b"];

/// Kinds of questions, each with its keys. `of[]` is the key `of` with a list of scenes.
const KINDS: [(&str, &[&str]); 12] = [
    ("scenes", &["scenes"]),
    ("scene", &["of"]),
    ("plan", &["of"]),
    ("run", &["of", "out"]),
    ("export", &["of", "format"]),
    ("loads", &["of", "out", "every"]),
    ("accuracy", &["of", "want", "within", "from"]),
    ("pattern", &["of[]"]),
    ("geometry", &["set", "facets", "thicken", "solids"]),
    ("word", &["statistic"]),
    ("statistics", &["points", "figures"]),
    ("weather", &["results"]),
];

/// Asks the library of answers random questions, from several threads at the same time
#[derive(Args, Clone, Debug)]
pub struct QuestionsCommand {
    /// Number of questions
    #[arg(long)]
    count: usize,
    /// Number of threads
    #[arg(long)]
    threads: usize,
    /// Seed of the random numbers
    #[arg(long)]
    seed: u64,
}

/// Statistics of the questions: number of replies of each kind, longest time with its question, and findings.
#[derive(Default)]
struct Tally {
    kinds: BTreeMap<String, usize>,
    longest: (Duration, String),
    findings: Vec<String>,
}

impl QuestionsCommand {
    /// Asks the questions and prints a table of the replies. Fails if a reply is invalid or reports an internal error,
    /// or if a thread has panicked.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("asking");
        let share = self.count.div_ceil(self.threads.max(1));
        // without `thread::scope`, which keeps a handle of the main thread that memcheck would report as a leak
        let spawned = |thread: usize| {
            let seed = self.seed.wrapping_add(thread as u64);
            thread::spawn(move || asked(share, seed))
        };
        let threads: Vec<_> = (0..self.threads.max(1)).map(spawned).collect();
        let tallies: Vec<Tally> = threads.into_iter().map(|one| one.join().unwrap_or_else(|_| lost())).collect();
        progress.finish();
        let mut all = Tally::default();
        for tally in tallies {
            tally.kinds.into_iter().for_each(|(kind, count)| *all.kinds.entry(kind).or_default() += count);
            all.longest = all.longest.max(tally.longest);
            all.findings.extend(tally.findings);
        }
        let mut shown = Table::new(["reply", "questions"]).left([0]);
        all.kinds.iter().for_each(|(kind, count)| shown.push([kind.clone(), count.to_string()]));
        print!("{}", shown.terminal());
        println!("longest: {:.1} s, {}", all.longest.0.as_secs_f64(), cut(&all.longest.1));
        match all.findings.first() {
            Some(first) => Err(Finding(format!("{} findings, the first: {first}", all.findings.len())).into()),
            None => Ok(()),
        }
    }
}

fn lost() -> Tally {
    Tally { findings: vec!["a thread was lost".into()], ..Tally::default() }
}

fn asked(count: usize, seed: u64) -> Tally {
    let (mut random, mut tally) = (Rng::with_seed(seed), Tally::default());
    for _ in 0..count {
        let (question, numbers) = (text(&mut random), numbers(&mut random));
        let Ok(written) = CString::new(question.clone()) else { continue };
        let begin = Instant::now();
        let reply = as_in_c(&written, &numbers, || begin.elapsed() < PATIENCE);
        let kind = kind(&reply);
        if kind.as_ref().is_none_or(|kind| kind == "internal") {
            tally.findings.push(format!("{} was answered by {}", cut(&question), cut(&reply)));
        }
        *tally.kinds.entry(kind.unwrap_or_default()).or_default() += 1;
        tally.longest = std::mem::take(&mut tally.longest).max((begin.elapsed(), question));
    }
    tally
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

/// Text of a question, sometimes corrupted.
fn text(random: &mut Rng) -> String {
    let mut text = question(random).to_string().into_bytes();
    if random.chance(5) {
        for _ in 0..=random.below(3) {
            let at = random.below(text.len());
            match random.below(3) {
                0 => text.truncate(at),
                1 => text[at] = 1 + random.below(255) as u8,
                _ => text.insert(at, random.pick(b"{}[],:\"0e-\\n")),
            }
            if text.is_empty() {
                break;
            }
        }
    }
    String::from_utf8_lossy(&text).into_owned()
}

fn question(random: &mut Rng) -> Value {
    let (kind, keys) = random.pick(&KINDS);
    let mut question = Map::new();
    question.insert("ask".into(), json!(kind));
    // most of the keys of this kind; the `if` after the loop sometimes adds a key that does not belong
    for key in keys {
        if !random.chance(12) {
            let name = if *key == "of[]" { "of" } else { *key };
            let value = if random.chance(25) { anything(random) } else { value(key, random) };
            question.insert(name.into(), value);
        }
    }
    if random.chance(40) {
        question.insert(random.pick(&["of", "set", "within", "nothing"]).into(), anything(random));
    }
    Value::Object(question)
}

fn value(key: &str, random: &mut Rng) -> Value {
    let odd = |random: &mut Rng| random.pick(&ODD).to_owned();
    match key {
        "of" => source(random),
        "of[]" => json!((0..random.below(3)).map(|_| source(random)).collect::<Vec<_>>()),
        "set" => assignments(random),
        "scenes" => json!(paths::scenes()),
        "out" => json!(if random.chance(3) { "/nowhere/at/all.csv" } else { "/dev/null/x.csv" }),
        "format" => json!(random.pick(&["ssv", "python", "pdf"])),
        "every" | "from" | "thicken" => json!(random.pick(&["1 ms", "0.1", "1e-300", "-1", "nan", "1 mm", "0.05mm"])),
        "within" => json!(random.pick(&["1%", "0.01", "5 %", "0", "nan", "1e-9", "200%", "1"])),
        "want" => json!((0..random.below(3)).map(|_| wanted(random)).collect::<Vec<_>>()),
        "solids" => json!(random.chance(2)),
        "facets" => json!([2, 7, 32, 0, 1_000_000][random.below(5)]),
        "statistic" => {
            json!(format!("{}{}", random.pick(&["mean", "mesh_order_", "order 2 of shaft", "tip"]), odd(random)))
        }
        "points" => json!([0, 1, 2, 4, 1_000_000_000_000u64][random.below(5)]),
        "figures" => json!([{"statistic": random.pick(&["mean", "rms", "time_of_peak", "mesh_order_1", "moon"]),
            "series": random.below(4), "phase": random.below(4)}]),
        _ => anything(random),
    }
}

/// Draws a scene: mostly an existing one, with changes.
fn source(random: &mut Rng) -> Value {
    let names = ["clunk", "hil", "limited_slip", "locked", "rattle", "split_friction", "study_turning", "torque_bias"];
    let name = if random.chance(10) { random.pick(&ODD) } else { random.pick(&names) };
    let mut source = json!({"name": name, "scenes": paths::scenes(), "set": assignments(random)});
    if random.chance(6) {
        let given = json!({"description": "given", "stop_time": odd_number(random), "step": odd_number(random),
            "outputs": ["left.speed"], "set": {variable(random): odd_number(random)},
            "table": [{"input": "left.load_torque", "time": [0, odd_number(random)], "value": [0, odd_number(random)]}]});
        source["given"] = given;
    }
    source
}

fn assignments(random: &mut Rng) -> Value {
    let assignment = |random: &mut Rng| {
        let name = if random.chance(6) { random.pick(&["stop_time", "step"]).to_owned() } else { variable(random) };
        let text = if random.chance(2) { random.pick(&ODD).to_owned() } else { odd_number(random).to_string() };
        if random.chance(30) { text } else { format!("{name}={text}") }
    };
    json!((0..random.below(4)).map(|_| assignment(random)).collect::<Vec<_>>())
}

fn wanted(random: &mut Rng) -> String {
    format!("{}:{}", variable(random), random.pick(&["mean", "max", "final", "mesh_order_1", "moon", ""]))
}

fn variable(random: &mut Rng) -> String {
    let rows = &table().rows;
    rows[random.below(rows.len())].name.to_owned()
}

fn odd_number(random: &mut Rng) -> Value {
    let plain = [0.0, 1.0, -1.0, 0.5, 1e-3, 1e9, 1e-12, 1e300, 3.0, 200.0];
    if random.chance(8) { json!(random.pick(&ODD)) } else { json!(random.pick(&plain) * random.between(0.5, 2.0)) }
}

fn anything(random: &mut Rng) -> Value {
    match random.below(7) {
        0 => Value::Null,
        1 => json!(random.chance(2)),
        2 => odd_number(random),
        3 => json!(random.pick(&ODD)),
        4 => json!([anything(random)]),
        5 => json!({"name": anything(random)}),
        _ => json!(vec![0; random.below(1000)]),
    }
}

/// Draws the numbers that belong to a question.
fn numbers(random: &mut Rng) -> Vec<f64> {
    let odd = [0.0, 1.0, 2.0, -1.0, 1e308, f64::NAN, f64::INFINITY];
    (0..random.below(13)).map(|i| if random.chance(4) { random.pick(&odd) } else { i as f64 }).collect()
}

/// First 400 characters of a text.
fn cut(text: &str) -> String {
    text.chars().take(400).collect()
}

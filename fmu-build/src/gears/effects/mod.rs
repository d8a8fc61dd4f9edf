//! Which effects a scene calls for: it is run with each of them on and off, and those that change its outputs by less
//! than a wanted accuracy are left out.
//!
//! 1. The scene as written is run, and the fullest scene: with all effects on that it allows.
//! 2. Each effect is turned the other way round in the scene as written ("alone"), and in the fullest ("among all").
//! 3. From the fullest scene effects are left out, the one of the least change first, as long as all that is left out
//!    together stays within the accuracy in every output; the plainest level of tooth contact that does comes first.
//!    What remains is the reduced scene. Its distance from the fullest is thus that of a run and no sum of changes, and
//!    effects that matter only together are kept.
//! 4. All runs are repeated in turn and their times on the processor compared.
//!
//! [`examine`] does it and returns [`Findings`]; [`table`], [`sentences`], [`csv`] and [`reduced`] tell them.

pub mod bench;
pub mod change;
pub mod csv;
pub mod job;
pub mod record;
pub mod reduced;
pub mod sentences;
pub mod switches;
pub mod table;
pub mod verdict;
pub mod words;

use anyhow::{Result, anyhow};

use crate::gears::scene::Scene;
use bench::{Bench, FULL, WRITTEN};
use change::{Change, Scale};
use switches::{Standing, Switch, Turned};
use verdict::Verdict;

/// Tolerances and fixed steps of further runs of the fullest scene, as parts of its own: how far they stray from it is
/// what its outputs cannot tell.
const FINER: [f64; 4] = [0.1, 0.5, 0.3, 0.2];
/// The first of these will do where it strays by less than this part of the accuracy.
const STEADY: f64 = 0.1;
/// A run is given up after this many times the evaluations of the fullest scene.
const PATIENCE: f64 = 100.0;
/// Evaluations that any run may take.
const FREE: f64 = 1e5;

/// What was found.
pub struct Findings {
    /// The scene as written.
    pub scene: Scene,
    /// The wanted accuracy, as a fraction.
    pub accuracy: f64,
    /// Time from which on outputs count [s].
    pub from: f64,
    /// Whether the fullest scene is the scene as written.
    pub as_written: bool,
    /// What 100 % of each output is.
    pub scales: Vec<Scale>,
    /// How far each output of the fullest scene strays when the integrator becomes finer.
    pub strays: Vec<f64>,
    /// What each output may change by: the accuracy, or what two runs stray.
    pub limits: Vec<f64>,
    /// A row for each effect and each lower level, those of the largest change first.
    pub rows: Vec<Finding>,
    /// The scene as written against the fullest.
    pub written: Trial,
    /// The reduced scene against the fullest.
    pub reduced: Trial,
    /// The reduced scene.
    pub reduced_scene: Scene,
    /// All runs with their costs.
    pub bench: Bench,
}

/// What was found of one effect or level.
pub struct Finding {
    /// Which.
    pub switch: Switch,
    /// How the scene stands to it.
    pub standing: Standing,
    /// The other way round in the scene as written.
    pub alone: Trial,
    /// The other way round in the fullest scene.
    pub among: Trial,
    /// Whether it is on in the fullest scene.
    pub in_full: bool,
    /// What follows.
    pub verdict: Verdict,
}

/// Something switched, against the scene without the switch.
#[derive(Clone)]
pub struct Trial {
    /// Number of the run that it is compared with: [`WRITTEN`] or [`FULL`].
    pub reference: usize,
    /// Number of its run, or why there is none.
    pub run: Result<usize, String>,
    /// Effects that went with a level.
    pub without: Vec<&'static str>,
}

impl Trial {
    /// Its change, if it ran.
    pub fn change<'a>(&self, bench: &'a Bench) -> Option<&'a Change> {
        self.run.as_ref().ok().map(|&run| bench.change(run, self.reference))
    }
}

/// What to examine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Wanted accuracy, as a fraction.
    pub accuracy: f64,
    /// Outputs count after this time [s].
    pub from: f64,
    /// Take the scene as written for the fullest: look at what may be left out, and not at what it lacks.
    pub as_written: bool,
    /// Repeat the runs and compare their times; without it there are counts alone.
    pub timed: bool,
}

/// Examines `scene`. `tell` hears how much of the work is done, and what is going on.
pub fn examine(scene: &Scene, question: &Question, tell: &mut dyn FnMut(f64, &str)) -> Result<Findings> {
    let Question { accuracy, from, as_written, timed } = *question;
    if scene.outputs.is_empty() {
        return Err(anyhow!("scene {} has no outputs to compare: name some under outputs", scene.name));
    }
    // two points make a mean over time
    if !(0.0..=scene.stop_time - 2.5 * scene.step).contains(&from) {
        return Err(anyhow!(
            "from {from} s: scene {} runs for {} s in steps of {} s",
            scene.name,
            scene.stop_time,
            scene.step
        ));
    }
    let switches: Vec<Switch> = switches::levels(scene).into_iter().chain(switches::effects()).collect();
    let mut work = Work { done: 0, of: 3 * switches.len() + 4, tell };
    let (mut bench, refused) = references(scene, question, &mut work)?;
    let strays = strays(&mut bench, accuracy, &mut work);
    // each of the two runs that are compared may have strayed
    let limits: Vec<f64> = strays.iter().map(|stray| accuracy.max(2.0 * stray)).collect();
    bench.most = FREE.max(PATIENCE * bench.runs[FULL].evaluations);
    let mut rows = Vec::new();
    for switch in switches {
        let name = switch.name();
        let alone = trial(&mut bench, WRITTEN, &switch, &mut work, &format!("{name} alone"));
        let mut among = trial(&mut bench, FULL, &switch, &mut work, &format!("{name} among all"));
        if let Some((_, why)) = refused.iter().find(|(other, _)| other.name() == name) {
            among.run = Err(why.clone());
        }
        let in_full = switch.is_on(&bench.runs[FULL].scene.parameters);
        let standing = switch.standing(scene);
        rows.push(Finding { switch, standing, alone, among, in_full, verdict: Verdict::Needed });
    }
    let reduced = verdict::decide(&mut bench, &mut rows, &limits, accuracy, &mut work);
    let size = |row: &Finding| row.among.change(&bench).map_or(-1.0, Change::largest);
    rows.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let trials = rows.iter().flat_map(|row| [&row.alone, &row.among]);
    let used: Vec<usize> = trials.filter_map(|trial| trial.run.clone().ok()).chain([WRITTEN, FULL, reduced]).collect();
    if timed {
        bench.measure(&used, work.tell);
    }
    let against_full = |run| Trial { reference: FULL, run: Ok(run), without: Vec::new() };
    Ok(Findings {
        scene: scene.clone(),
        accuracy,
        from,
        as_written,
        scales: bench.scales.clone(),
        strays,
        limits,
        rows,
        written: against_full(WRITTEN),
        reduced: against_full(reduced),
        reduced_scene: bench.runs[reduced].scene.clone(),
        bench,
    })
}

/// How much is done.
pub struct Work<'a> {
    done: usize,
    of: usize,
    tell: &'a mut dyn FnMut(f64, &str),
}

impl Work<'_> {
    /// Next piece.
    pub fn next(&mut self, what: &str) {
        (self.tell)(self.done as f64 / self.of.max(1) as f64, what);
        self.done += 1;
    }
}

/// Runs the scene as written and the fullest, and tells what the fullest lacks and why.
#[allow(clippy::type_complexity)]
fn references(scene: &Scene, question: &Question, work: &mut Work) -> Result<(Bench, Vec<(Switch, String)>)> {
    let from = question.from;
    work.next("the scene as written");
    let written = bench::of(scene, from, f64::INFINITY).map_err(|why| anyhow!("scene {}: {why}", scene.name))?;
    if question.as_written {
        return Ok((Bench::new(from, scene, written.clone(), scene, written), Vec::new()));
    }
    let (mut full, refused) = switches::fullest(scene);
    let mut refused: Vec<(Switch, String)> = refused.into_iter().map(|(s, p)| (s, bench::told(&p))).collect();
    work.next("all effects");
    let whole = match bench::of(&full, from, f64::INFINITY) {
        Ok(whole) => whole,
        Err(_) => {
            // what starts may still fail under way: one by one then, without those that do
            let mut last = written.clone();
            full = scene.clone();
            for switch in switches::effects().filter(|switch| switch.standing(scene) == Standing::Off) {
                let Ok(Turned { scene: more, .. }) = switch.turned(&full) else { continue };
                match bench::of(&more, from, f64::INFINITY) {
                    Ok(run) => (full, last) = (more, run),
                    Err(why) => refused.push((switch, why)),
                }
            }
            last
        }
    };
    Ok((Bench::new(from, scene, written, &full, whole), refused))
}

/// How far outputs of the fullest scene stray when nothing but the integrator becomes finer.
fn strays(bench: &mut Bench, accuracy: f64, work: &mut Work) -> Vec<f64> {
    let mut strays = vec![0.0; bench.scales.len()];
    for part in FINER {
        work.next("the integrator's own error");
        let mut scene = bench.runs[FULL].scene.clone();
        let solver = &mut scene.parameters.solver;
        (solver.relative_tolerance, solver.fixed_step) = (part * solver.relative_tolerance, part * solver.fixed_step);
        // what is below the ranges tells nothing
        let Ok(run) = bench.run(&scene) else { continue };
        for (stray, change) in strays.iter_mut().zip(&bench.change(run, FULL).outputs) {
            *stray = f64::max(*stray, change.by);
        }
        if strays.iter().all(|&stray| stray < STEADY * accuracy) {
            break;
        }
    }
    strays
}

fn trial(bench: &mut Bench, reference: usize, switch: &Switch, work: &mut Work, what: &str) -> Trial {
    work.next(what);
    match switch.turned(&bench.runs[reference].scene) {
        Ok(Turned { scene, without }) => Trial { reference, run: bench.run(&scene), without },
        Err(problems) => Trial { reference, run: Err(bench::told(&problems)), without: Vec::new() },
    }
}

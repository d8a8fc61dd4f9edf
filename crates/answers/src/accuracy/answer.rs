//! The answer to a question of accuracy.

use anyhow::Result;
use bevel_differential::variables::{Variable, assign};

use super::Question;
use super::bench::{Bench, Trial};
use super::gears::Gears;
use super::reference::{self, Richest};
use super::search::{Found, is_within, search};
use super::switches::{Status, Switch, effects};
use super::want::{self, Want};
use crate::problem::question_error;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::scene::run::SceneRun;

/// Price of all runs, in that of a reference run; and of a reference that is not certain, as little can be told.
const BUDGET: f64 = 30.0;
const BUDGET_UNCERTAIN: f64 = 15.0;
/// Two points make a mean over time.
const LEAST_POINTS: f64 = 2.5;
/// An effect with parameters at zero that changes less than this part of the accuracy is neutral: what is left is that of
/// other steps.
const NOTHING: f64 = 0.01;

/// What was found.
pub struct Answer {
    /// The scene with the wanted outputs.
    pub scene: Scene,
    /// The wanted quantities.
    pub wants: Vec<Want>,
    /// Wanted accuracy, as a fraction.
    pub within: f64,
    /// Time from which on outputs count [s].
    pub from: f64,
    /// What runs were compared with; its errors are how far it strays.
    pub reference: Trial,
    /// What 100 % of each quantity is.
    pub scales: Vec<f64>,
    /// All runs.
    pub trials: Vec<Trial>,
    /// Number of the chosen run; none if nothing is accurate enough.
    pub chosen: Option<usize>,
    /// The next cheaper run, which fails.
    pub too_coarse: Option<usize>,
    /// The next dearer run with a smaller error.
    pub richer: Option<usize>,
    /// Plainer levels and laws.
    pub gears: Vec<(Gears, Result<usize, String>)>,
    /// Why each effect is in or out.
    pub effects: Vec<(Switch, Role)>,
    /// Price of all runs over that of a reference run.
    pub spent: f64,
}

/// What an effect does to the wanted quantities.
#[derive(Clone)]
pub enum Role {
    /// Without it a quantity changes by so much, and it is in the chosen setting or not.
    Acts {
        /// Largest change.
        by: f64,
        /// Whether the chosen setting has it.
        chosen: bool,
    },
    /// Its parameters are zero, or what it acts on is not there; typical values would change a quantity by so much.
    Neutral {
        /// The values that the scene leaves at zero, with typical ones.
        typical: Vec<(&'static Variable, f64)>,
        /// Largest change by them, if they were tried.
        by: Option<f64>,
        /// Change by the values that the scene has.
        now: f64,
    },
    /// The plainer level that is chosen does not know it, and is accurate enough all the same.
    NotKnown,
    /// Part of the question: what is built in, broken or driven, and not in this scene.
    NotInScene,
    /// Set off by the scene.
    SetOff,
    /// Gives outputs alone, and none of them is wanted.
    NotAsked,
    /// Runs without it do not come to their end, and why.
    Kept(String),
    /// Does not go with the scene, and why.
    Refused(String),
}

impl Answer {
    /// Whether the reference itself is not sure to a third of the accuracy.
    pub fn is_uncertain(&self) -> bool {
        3.0 * self.reference.error() > self.within
    }

    /// The chosen run.
    pub fn choice(&self) -> Option<&Trial> {
        self.chosen.map(|chosen| &self.trials[chosen])
    }
}

/// Answers `question` for `scene`. `progress` reports each run to the caller, who may stop the work.
pub fn answer(scene: &Scene, question: &Question, progress: &mut Progress) -> Result<Answer> {
    let (scene, wants) = want::parse(scene, &question.wants).map_err(question_error)?;
    let latest = scene.stop_time - LEAST_POINTS * scene.step;
    if !(0.0..=latest).contains(&question.from) {
        let Scene { name, stop_time, step, .. } = &scene;
        let runs = format!("scene {name} runs for {stop_time} s in steps of {step} s");
        return Err(question_error(if latest < 0.0 {
            format!("{runs}, too short to judge; make stop_time longer or step shorter")
        } else {
            format!("--from {} s: {runs}; at most {latest} s leaves something to judge", question.from)
        }));
    }
    progress.warn(SceneRun::start(&scene, scene.step)?.warnings());
    let richest = reference::richest(&scene)?;
    let (reference, spent) = reference::run(&richest.scene, &wants, question, progress)?;
    let uncertain = 3.0 * reference.0.error() > question.within;
    let limit = if uncertain { BUDGET_UNCERTAIN } else { BUDGET } * reference.0.cost;
    let mut bench = Bench::new(&wants, question.from, reference, [spent, limit], progress);
    let found = search(&mut bench, &scene, &richest, question.within);
    let roles = roles(&mut bench, &scene, &richest, &found, question.within);
    let [too_coarse, richer] = neighbours(&bench, question.within, found.chosen);
    // runs that were stopped have failed, and mean nothing
    bench.progress.check_stopped()?;
    let Bench { reference, scales, trials, spent, .. } = bench;
    Ok(Answer {
        within: question.within,
        from: question.from,
        spent: spent / reference.cost,
        gears: found.gears.into_iter().map(|single| (single.of, single.run)).collect(),
        effects: roles,
        chosen: found.chosen,
        reference,
        scales,
        trials,
        too_coarse,
        richer,
        scene,
        wants,
    })
}

/// The dearest run that is cheaper than `chosen` and fails, and the cheapest that is dearer and nearer to the reference. Only runs
/// of the same method count, because costs of different methods cannot be compared.
fn neighbours(bench: &Bench, within: f64, chosen: Option<usize>) -> [Option<usize>; 2] {
    let Some(chosen) = chosen else { return [None; 2] };
    let method = |run: &usize| bench.trials[*run].scene.parameters.solver.method;
    let runs = || (0..bench.trials.len()).filter(|run| method(run) == method(&chosen));
    let (cost, error) = (bench.trials[chosen].cost, bench.trials[chosen].error());
    let by_cost = |a: &usize, b: &usize| bench.trials[*a].cost.total_cmp(&bench.trials[*b].cost);
    let fails = |&run: &usize| bench.trials[run].cost < cost && !is_within(bench, within, run);
    let nearer = |&run: &usize| bench.trials[run].cost > cost && bench.trials[run].error() < error;
    [runs().filter(fails).max_by(by_cost), runs().filter(nearer).min_by(by_cost)]
}

/// Why each effect is in or out.
fn roles(bench: &mut Bench, scene: &Scene, richest: &Richest, found: &Found, within: f64) -> Vec<(Switch, Role)> {
    let chosen = found.chosen.map(|run| bench.trials[run].scene.parameters);
    let mut roles = Vec::new();
    for switch in effects() {
        let single = found.effects.iter().find(|single| single.of.name() == switch.name());
        let refused = richest.refused.iter().find(|(name, _)| *name == switch.name());
        let in_rich = switch.is_on(&richest.scene.parameters);
        let role = match (single.map(|single| &single.run), switch.status(scene)) {
            (Some(Ok(run)), _) => match found.base {
                Some(base) => acting(bench, &switch, [*run, base], chosen.is_some_and(|p| switch.is_on(&p)), within),
                None => continue,
            },
            (Some(Err(why)), _) => Role::Kept(why.clone()),
            (None, Status::NotAsked) => Role::NotAsked,
            (None, _) if in_rich => Role::NotKnown,
            (None, Status::SetOff) => Role::SetOff,
            (None, Status::NotInScene) => Role::NotInScene,
            (None, Status::On | Status::Off) => Role::Refused(
                refused.map_or_else(|| format!("not with {}", richest.gears.text()), |(_, why)| why.clone()),
            ),
        };
        // what the plainer level does not know may have been at zero
        let role = match (role, found.rich) {
            (Role::NotKnown, Some(rich)) => {
                let typical = switch.typical(&bench.trials[rich].scene);
                if typical.is_empty() { Role::NotKnown } else { neutral(bench, &switch, rich, typical, 0.0) }
            }
            (role, _) => role,
        };
        roles.push((switch, role));
    }
    roles
}

/// What an effect does between two runs, without it and with it.
fn acting(bench: &mut Bench, switch: &Switch, [without, with]: [usize; 2], chosen: bool, within: f64) -> Role {
    let by = change(bench, without, with);
    let typical = switch.typical(&bench.trials[with].scene);
    // with all values at zero, what is left is that of other steps
    let nothing = if switch.is_at_zero(&bench.trials[with].scene) { within } else { NOTHING * within };
    if by <= nothing && !chosen && !typical.is_empty() {
        neutral(bench, switch, with, typical, if by <= NOTHING * within { 0.0 } else { by })
    } else {
        Role::Acts { by, chosen }
    }
}

/// Largest difference between two runs, as a part of the scales.
fn change(bench: &Bench, run: usize, other: usize) -> f64 {
    let pairs = bench.trials[run].values.iter().zip(&bench.trials[other].values).zip(&bench.scales);
    pairs.fold(0.0, |most, ((&a, &b), &scale)| f64::max(most, Want::error(a, b, scale)))
}

/// An effect that changes nothing, or too little by `now`, with what typical values would do.
fn neutral(bench: &mut Bench, switch: &Switch, rich: usize, typical: Vec<(&'static Variable, f64)>, now: f64) -> Role {
    if !bench.has_room(bench.trials[rich].cost) {
        return Role::Neutral { typical, by: None, now };
    }
    let mut scene = bench.trials[rich].scene.clone();
    for &(row, value) in &typical {
        // typical values are within their ranges
        let fits = assign(row, value, &mut scene.parameters, &mut scene.inputs);
        debug_assert_eq!(fits, Ok(()));
    }
    let run = bench.run(&scene, &format!("typical values of {}", switch.name()));
    let by = run.ok().map(|run| change(bench, run, rich));
    Role::Neutral { typical, by, now }
}

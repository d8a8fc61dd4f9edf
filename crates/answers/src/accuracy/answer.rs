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
use crate::scene::run::SceneRun;
use crate::scene::{Scene, off};

/// Maximum cost of all runs, as a multiple of the cost of the reference run.
const BUDGET: f64 = 30.0;
/// Maximum cost of all runs if the reference is uncertain, because more runs would then decide little.
const BUDGET_UNCERTAIN: f64 = 15.0;
/// Shortest time to judge, in communication steps: a mean over time needs two points.
const LEAST_POINTS: f64 = 2.5;
/// An effect whose parameters are zero has no influence if the result changes by less than this fraction of the
/// accuracy. Such small changes come from different step sizes.
const NEGLIGIBLE: f64 = 0.01;

/// Result of the search.
pub struct Answer {
    /// The scene with the wanted outputs.
    pub scene: Scene,
    /// The wanted quantities.
    pub wants: Vec<Want>,
    /// Wanted accuracy, as a fraction.
    pub within: f64,
    /// Time after which outputs count [s].
    pub from: f64,
    /// Run that all others are compared with. Its errors are its own uncertainty.
    pub reference: Trial,
    /// Size of 100 % of each quantity.
    pub scales: Vec<f64>,
    /// All runs.
    pub trials: Vec<Trial>,
    /// Index of the chosen run; `None` if nothing is accurate enough.
    pub chosen: Option<usize>,
    /// The next cheaper run, which fails.
    pub too_coarse: Option<usize>,
    /// The next more expensive run with a smaller error.
    pub richer: Option<usize>,
    /// Plainer levels and laws, each with its run or the reason for its failure.
    pub gears: Vec<(Gears, Result<usize, String>)>,
    /// Role of each effect.
    pub effects: Vec<(Switch, Role)>,
    /// Cost of all runs divided by that of a reference run.
    pub spent: f64,
}

/// Influence of an effect on the wanted quantities.
#[derive(Clone)]
pub enum Role {
    /// A quantity changes without the effect.
    Acts {
        /// Largest change.
        by: f64,
        /// True if the chosen setting has the effect.
        chosen: bool,
    },
    /// No influence, because the parameters are zero or the part on which the effect acts is missing. Typical values
    /// may have an influence.
    Neutral {
        /// The parameters that the scene leaves at zero, with typical values.
        typical: Vec<(&'static Variable, f64)>,
        /// Largest change with typical values, if they were tried.
        by: Option<f64>,
        /// Change with the values of the scene.
        now: f64,
    },
    /// Not part of the chosen plainer level, which is accurate enough without it.
    NotOnLevel,
    /// Part of the question, because it says what is built in, broken or driven, but not in this scene.
    NotInScene,
    /// Switched off by the scene.
    SetOff,
    /// Only adds outputs, none of which is wanted.
    NotAsked,
    /// No run is without it, for this reason.
    Kept(String),
    /// Does not fit the scene, for this reason.
    Refused(String),
}

impl Answer {
    /// True if the uncertainty of the reference exceeds a third of the accuracy.
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
    progress.warn(off::warnings(&richest.scene));
    let (reference, spent) = reference::run(&richest.scene, &wants, question, progress)?;
    let uncertain = 3.0 * reference.0.error() > question.within;
    let limit = if uncertain { BUDGET_UNCERTAIN } else { BUDGET } * reference.0.cost;
    let mut bench = Bench::new(&wants, question.from, reference, [spent, limit], progress);
    let found = search(&mut bench, &scene, &richest, question.within);
    let roles = roles(&mut bench, &scene, &richest, &found, question.within);
    let [too_coarse, richer] = neighbours(&bench, question.within, found.chosen);
    // a stopped run counts as failed, so results after a stop are meaningless
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

/// The most expensive run that is cheaper than `chosen` but not accurate enough, and the cheapest run that is more
/// expensive and closer to the reference. Only runs of the same method count, because costs of different methods cannot
/// be compared.
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

/// Role of each effect.
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
            (None, _) if in_rich => Role::NotOnLevel,
            (None, Status::SetOff) => Role::SetOff,
            (None, Status::Plain) => continue,
            (None, Status::NotInScene) => Role::NotInScene,
            (None, Status::On | Status::Off) => Role::Refused(
                refused.map_or_else(|| format!("not with {}", richest.gears.text()), |(_, why)| why.clone()),
            ),
        };
        // the scene may have left parameters at zero that belong to effects missing on the plainer level
        let role = match (role, found.rich) {
            (Role::NotOnLevel, Some(rich)) => {
                let typical = switch.typical(&bench.trials[rich].scene);
                if typical.is_empty() { Role::NotOnLevel } else { neutral(bench, &switch, rich, typical, 0.0) }
            }
            (role, _) => role,
        };
        roles.push((switch, role));
    }
    roles
}

/// Influence of an effect, from a run without it and a run with it.
fn acting(bench: &mut Bench, switch: &Switch, [without, with]: [usize; 2], chosen: bool, within: f64) -> Role {
    let by = change(bench, without, with);
    let typical = switch.typical(&bench.trials[with].scene);
    // with all values at zero, only different step sizes change the result
    let nothing = if switch.is_at_zero(&bench.trials[with].scene) { within } else { NEGLIGIBLE * within };
    if by <= nothing && !chosen && !typical.is_empty() {
        neutral(bench, switch, with, typical, if by <= NEGLIGIBLE * within { 0.0 } else { by })
    } else {
        Role::Acts { by, chosen }
    }
}

/// Largest difference between two runs, as a fraction of the scales.
fn change(bench: &Bench, run: usize, other: usize) -> f64 {
    let pairs = bench.trials[run].values.iter().zip(&bench.trials[other].values).zip(&bench.scales);
    pairs.fold(0.0, |most, ((&a, &b), &scale)| f64::max(most, Want::error(a, b, scale)))
}

/// Role of an effect that changes nothing, or only by `now` through other step sizes. If the budget allows it, a run with
/// typical values shows their influence.
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

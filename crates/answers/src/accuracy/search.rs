//! The search for the cheapest combination that is accurate enough.

use bevel_differential::model::{Method, SolverSpec};
use bevel_differential::variables::named;

use super::bench::Bench;
use super::gears::{self, Gears};
use super::record::GIVEN_UP;
use super::reference::{Richest, at_tolerance};
use super::switches::{Switch, effects, settled};
use crate::scene::Scene;
use crate::scene::set::Setting;

/// Tolerance at which levels, laws and effects are compared, as a fraction of the accuracy.
const SCREEN: f64 = 1e-3;
/// Bounds of this tolerance.
const SCREENS: [f64; 2] = [1e-7, 1e-4];
/// Maximum error of the comparisons themselves, as a fraction of the accuracy.
const SCREEN_ERROR: f64 = 0.2;
/// Minimum fraction of the cost that leaving out an effect must save.
const SAVES: f64 = 0.01;
/// Effects whose individual changes add up to less than this fraction of the accuracy are left out together.
const TOGETHER: f64 = 0.3;
/// An effect that on its own changes a quantity by more than this multiple of the accuracy is not tried again in a
/// combination.
const HOPELESS: f64 = 3.0;
/// Number of accurate gears that are optimised, the plainest first.
const STARTS: usize = 2;
/// Maximum cost of a result with richer gears, as a fraction of the cost with plainer gears, at which it is preferred.
const CHEAPER: f64 = 0.5;
/// Factor from one tolerance to the next looser one.
const LOOSER: f64 = 10.0;
/// Loosest tolerance.
const LOOSEST: f64 = 1e-2;
/// Parameter of the fixed step size.
const STEP: &str = "solver.fixed_step";

/// A run with one level or law, or without one effect.
#[derive(Clone)]
pub struct Single<T> {
    /// The level and law, or the effect.
    pub of: T,
    /// Index of the run, or the reason for its failure.
    pub run: Result<usize, String>,
}

/// Results of the search.
pub struct Found {
    /// Run of the richest model at the tolerance of the comparisons.
    pub rich: Option<usize>,
    /// Plainer levels and laws with all effects that they support, the plainest first.
    pub gears: Vec<Single<Gears>>,
    /// Run of the plainest accurate gears with all effects that they support.
    pub base: Option<usize>,
    /// Runs of the plainest accurate gears without each of their effects.
    pub effects: Vec<Single<Switch>>,
    /// Run of the chosen combination; `None` if all runs fail or no fixed step is accurate enough.
    pub chosen: Option<usize>,
}

/// True if run `i` is accurate enough: its error plus the reference's uncertainty is within the accuracy. If the
/// reference is uncertain, an error up to the accuracy or up to twice the uncertainty is allowed.
pub fn is_within(bench: &Bench, within: f64, i: usize) -> bool {
    let errors = bench.trials[i].errors.iter().zip(&bench.reference.errors);
    errors.into_iter().all(|(&error, &stray)| {
        let certain = 3.0 * stray <= within;
        if certain { error + stray <= within } else { error <= within.max(2.0 * stray) }
    })
}

/// Searches for combinations plainer than the richest scene. The adaptive method compares levels, laws and effects even
/// if the scene requests fixed steps.
pub fn search(bench: &mut Bench, scene: &Scene, richest: &Richest, within: f64) -> Found {
    let (screen, rich) = screening(bench, &richest.scene, within);
    let rich_scene = Scene { parameters: at_tolerance(&richest.scene.parameters, screen), ..richest.scene.clone() };
    let plainer = gears::plainer(scene, richest.gears);
    let gears: Vec<Single<Gears>> = plainer
        .iter()
        .map(|&gears| Single { of: gears, run: on_gears(bench, gears, &rich_scene, "all effects") })
        .collect();
    let starts = gears.iter().filter_map(|single| single.run.clone().ok()).chain(rich);
    let starts: Vec<usize> = starts.filter(|&run| is_within(bench, within, run)).collect();
    let base = starts.first().copied().or(rich);
    let effects = base.map_or(Vec::new(), |base| without_each(bench, base));
    let is_fixed = scene.parameters.solver.method == Method::FixedStep;
    let mut chosen: Option<usize> = None;
    // the two plainest accurate gears: the richer of the two may be cheaper because its teeth are softer
    for &start in starts.iter().take(STARTS) {
        let reduced = leave_out(bench, start, &effects, &[], scene, within);
        let reduced = if is_fixed {
            // richer gears cost more per step, so they would not allow shorter steps
            let Some(stepped) = in_fixed_steps(bench, reduced, scene, within) else { break };
            stepped
        } else {
            let mut best = loosen(bench, reduced, within);
            // the same with the effects of the scene that save time, such as corner contact, without which forces jump
            let kept = savers(bench, &effects, base, scene);
            if !kept.is_empty() {
                let with = leave_out(bench, start, &effects, &kept, scene, within);
                let with = loosen(bench, with, within);
                if bench.trials[with].cost < (1.0 - SAVES) * bench.trials[best].cost {
                    best = with;
                }
            }
            best
        };
        if chosen.is_none_or(|best| bench.trials[reduced].cost < CHEAPER * bench.trials[best].cost) {
            chosen = Some(reduced);
        }
    }
    // nothing plainer is accurate enough: the richest model, at the reference's own tolerance or in fixed steps
    let chosen = chosen.or_else(|| {
        if is_fixed {
            let rich = rich.filter(|_| starts.is_empty())?;
            return in_fixed_steps(bench, rich, scene, within);
        }
        let scene = bench.reference.scene.clone();
        bench.run(&scene, "the reference").ok()
    });
    let chosen = chosen.map(|chosen| minimal(bench, chosen, &plainer, scene, within));
    Found { rich, gears, base, effects, chosen }
}

/// Runs `scene` with other gears, without the effects that they do not support.
fn on_gears(bench: &mut Bench, gears: Gears, scene: &Scene, what: &str) -> Result<usize, String> {
    let found = gears.of_scene(scene).map_err(|found| super::record::in_one_line(&found))?;
    bench.run(&found.scene, &format!("{what} on gears {}", gears.text()))
}

/// Repeats run `base` without each of its effects.
fn without_each(bench: &mut Bench, base: usize) -> Vec<Single<Switch>> {
    let scene = bench.trials[base].scene.clone();
    let on = effects().filter(|switch| switch.is_on(&scene.parameters));
    on.map(|switch| {
        let off = switch.turned(&scene, false);
        let run = match switch.commands(&scene) {
            Some(input) => Err(format!("{input} commands the scene")),
            None => bench
                .run(&off, &format!("without {}", switch.name()))
                .map_err(|why| format!("the run without it fails: {why}")),
        };
        Single { of: switch, run }
    })
    .collect()
}

/// Makes the gears of the chosen setting plainer and removes its effects, one by one, until every remaining part is
/// needed. These runs are cheap, and the failed ones show the next coarser settings.
fn minimal(bench: &mut Bench, mut chosen: usize, plainer: &[Gears], written: &Scene, within: f64) -> usize {
    loop {
        let scene = bench.trials[chosen].scene.clone();
        let own = Gears::of(&scene.parameters);
        let may_go = |switch: &Switch| !switch.is_bodies() && switch.commands(&scene).is_none();
        let on = effects().filter(|switch| switch.is_on(&scene.parameters) && may_go(switch));
        let less = on.map(|switch| {
            let what = format!("also without {}", switch.name());
            (switch.turned(&scene, false), what, !switch.is_on(&written.parameters))
        });
        let lower = plainer.iter().take_while(|&&gears| gears != own).filter_map(|&gears| {
            Some((gears.of_scene(&scene).ok()?.scene, format!("the same on gears {}", gears.text()), false))
        });
        let variants: Vec<(Scene, String, bool)> = lower.chain(less).collect();
        let mut tried = variants.iter();
        let better = tried.find_map(|(scene, what, plainer)| attempt(bench, chosen, scene, what, *plainer, within));
        match better {
            Some(run) => chosen = run,
            None => return chosen,
        }
    }
}

/// Returns the loosest tolerance at which the richest model is accurate enough to compare others with it, and its run.
fn screening(bench: &mut Bench, richest: &Scene, within: f64) -> (f64, Option<usize>) {
    let mut screen = (SCREEN * within).clamp(SCREENS[0], SCREENS[1]);
    let finest = bench.reference.scene.parameters.solver.relative_tolerance;
    let enough = (SCREEN_ERROR * within).max(2.0 * bench.reference.error());
    loop {
        let scene = Scene { parameters: at_tolerance(&richest.parameters, screen), ..richest.clone() };
        let run = bench.run(&scene, &format!("all effects, tolerance {screen:.0e}")).ok();
        let does = run.is_some_and(|run| bench.trials[run].error() <= enough);
        if does || screen <= 10.0 * finest {
            return (screen, run);
        }
        screen /= 10.0;
    }
}

/// Leaves effects out of run `start`, those with the smallest change first, while the result stays accurate enough and
/// becomes cheaper. Effects that the scene as `written` does not have are left out even if that is more expensive,
/// because they must not be added only to save time. Effects in `kept` are left out only if that is cheaper.
fn leave_out(
    bench: &mut Bench,
    start: usize,
    singles: &[Single<Switch>],
    kept: &[Switch],
    written: &Scene,
    within: f64,
) -> usize {
    let size = |bench: &Bench, single: &Single<Switch>| {
        single.run.as_ref().map_or(f64::INFINITY, |&run| bench.trials[run].error())
    };
    let mut left: Vec<&Single<Switch>> =
        singles.iter().filter(|single| single.of.is_on(&bench.trials[start].scene.parameters)).collect();
    left.sort_by(|a, b| size(bench, a).total_cmp(&size(bench, b)));
    let mut current = start;
    // most effects do not matter: all of them together
    let (mut sum, error) = (0.0, bench.trials[start].error());
    let few = left.iter().take_while(|single| {
        sum += (size(bench, single) - error).max(0.0);
        sum <= TOGETHER * within
    });
    let few = few.count();
    let (others, batch): (Vec<&Single<Switch>>, Vec<&Single<Switch>>) =
        left[..few].iter().copied().partition(|single| kept.iter().any(|of| of.name() == single.of.name()));
    if batch.len() > 1 {
        let mut scene = bench.trials[current].scene.clone();
        batch.iter().for_each(|single| single.of.set(&mut scene.parameters, false));
        if let Some(less) = attempt(bench, current, &scene, "without all that do not matter", true, within) {
            current = less;
            left.splice(..few, others);
        }
    }
    for single in left {
        if single.run.is_ok() && size(bench, single) > HOPELESS * within || single.of.commands(written).is_some() {
            continue;
        }
        let scene = single.of.turned(&bench.trials[current].scene, false);
        let what = format!("also without {}", single.of.name());
        let plainer = !single.of.is_on(&written.parameters);
        if let Some(less) = attempt(bench, current, &scene, &what, plainer, within) {
            current = less;
        }
    }
    current
}

/// Effects of the scene as `written` without which a run costs more than run `base`, which has all effects of `singles`.
fn savers(bench: &Bench, singles: &[Single<Switch>], base: Option<usize>, written: &Scene) -> Vec<Switch> {
    let cost = |run: usize| bench.trials[run].cost;
    let costs_more = |single: &&Single<Switch>| {
        let runs = single.run.as_ref().ok().zip(base);
        single.of.is_on(&written.parameters)
            && runs.is_some_and(|(&without, with)| cost(without) > (1.0 + SAVES) * cost(with))
    };
    singles.iter().filter(costs_more).map(|single| single.of).collect()
}

/// Returns the run of `scene` if it is accurate enough, and `plainer` or cheaper than run `current`.
fn attempt(bench: &mut Bench, current: usize, scene: &Scene, what: &str, plainer: bool, within: f64) -> Option<usize> {
    if !bench.has_room(bench.trials[current].cost) {
        return None;
    }
    let scene = settled(scene).ok()?.scene;
    let run = bench.run(&scene, what).ok()?;
    let cheaper = bench.trials[run].cost < (1.0 - SAVES) * bench.trials[current].cost;
    ((plainer || cheaper) && is_within(bench, within, run)).then_some(run)
}

/// Loosens the tolerance of run `current` while the result stays accurate enough and becomes cheaper.
fn loosen(bench: &mut Bench, current: usize, within: f64) -> usize {
    let mut best = current;
    let mut tolerance = bench.trials[current].scene.parameters.solver.relative_tolerance;
    while tolerance < 0.99 * LOOSEST {
        tolerance *= LOOSER;
        let mut scene = bench.trials[current].scene.clone();
        scene.parameters = at_tolerance(&scene.parameters, tolerance);
        match attempt(bench, best, &scene, &format!("tolerance {tolerance:.0e}"), false, within) {
            Some(looser) => best = looser,
            None => break,
        }
    }
    best
}

/// Returns the run of `current` with the longest fixed steps that are accurate enough. A step size counts only if the
/// next shorter one is accurate too, because errors of long steps may cancel by chance.
fn in_fixed_steps(bench: &mut Bench, current: usize, written: &Scene, within: f64) -> Option<usize> {
    let mut scene = bench.trials[current].scene.clone();
    let mut longest: Option<usize> = None;
    // cost times step, which is nearly the same for all runs
    let mut cost_of_steps = 0.0;
    for step in fixed_steps(written.step) {
        if !bench.has_room(cost_of_steps / step) {
            break;
        }
        scene.parameters.solver = SolverSpec { fixed_step: step, ..written.parameters.solver };
        // the setting contains its step, even if that is the start value
        scene.settings.retain(|setting| setting.row.name != STEP);
        scene.settings.extend(named(STEP).and_then(|row| Setting::of(row, &scene.parameters, &scene.inputs)));
        let run = bench.run(&scene, &format!("fixed steps of {step:e} s"));
        if run.as_ref().is_err_and(|why| why.starts_with(GIVEN_UP)) {
            break;
        }
        let run = run.ok();
        let enough = run.filter(|&run| is_within(bench, within, run));
        if enough.is_some() && longest.is_some() {
            break;
        }
        longest = enough;
        cost_of_steps = run.map_or(cost_of_steps, |run| bench.trials[run].cost * step);
    }
    longest
}

/// Fixed step sizes to try [s]: 1, 2 and 5 in each decade of their range. The first one is the shortest that spans a
/// whole communication step.
fn fixed_steps(communication_step: f64) -> Vec<f64> {
    let range = named(STEP).and_then(|row| row.range).map_or([1e-7, 1e-2], |range| [range.min, range.max]);
    let decades = (-12..=0).rev();
    let row = decades.flat_map(|decade| [5, 2, 1].map(|digit| format!("{digit}e{decade}")));
    let row = row.filter_map(|text| text.parse().ok()).filter(|size| (range[0]..=range[1]).contains(size));
    let row: Vec<f64> = row.collect();
    let whole = row.iter().rposition(|&size| size >= communication_step * (1.0 - 1e-6));
    row[whole.unwrap_or(0)..].to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_fixed_step_spans_a_communication_step() {
        for (communication_step, first) in
            [(1e-3, [1e-3, 5e-4, 2e-4]), (3e-4, [5e-4, 2e-4, 1e-4]), (1.0, [1e-2, 5e-3, 2e-3])]
        {
            let steps = fixed_steps(communication_step);
            assert_eq!((&steps[..3], steps.last()), (&first[..], Some(&1e-7)));
        }
        assert_eq!(fixed_steps(1e-9), [1e-7]);
    }
}

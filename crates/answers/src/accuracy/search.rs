//! The search for the cheapest combination that is accurate enough.

use bevel_differential::model::Method;

use super::bench::Bench;
use super::gears::{self, Gears};
use super::reference::{Richest, at_tolerance};
use super::switches::{Switch, effects, settled};
use crate::scene::Scene;

/// Tolerance at which levels, laws and effects are compared, as a part of the accuracy; and its range.
const SCREEN: f64 = 1e-3;
const SCREENS: [f64; 2] = [1e-7, 1e-4];
/// The error of the screening itself is below this part of the accuracy.
const SCREEN_ERROR: f64 = 0.2;
/// An effect is left out only if that saves this part.
const SAVES: f64 = 0.01;
/// Effects whose changes by themselves are together below this part of the accuracy leave at once.
const TOGETHER: f64 = 0.3;
/// An effect that changes a quantity by more than this many accuracies by itself is not tried again in a combination.
const HOPELESS: f64 = 3.0;
/// So many of the plainest gears that will do are followed to the end; richer gears must be cheaper than this part.
const STARTS: usize = 2;
const CHEAPER: f64 = 0.5;
/// Loosened tolerances: factors of the one before.
const LOOSER: f64 = 10.0;
const LOOSEST: f64 = 1e-2;
/// A method with other steps must be cheaper than this part of the adaptive one in measured time.
const FASTER: f64 = 0.8;

/// What a level or law does by itself, or a model without an effect.
#[derive(Clone)]
pub struct Single<T> {
    /// Which.
    pub of: T,
    /// Number of its run, or why there is none.
    pub run: Result<usize, String>,
}

/// What the search found.
pub struct Found {
    /// The richest model at the tolerance of the comparisons.
    pub rich: Option<usize>,
    /// Plainer levels and laws with all effects that they know, the plainest first.
    pub gears: Vec<Single<Gears>>,
    /// The plainest gears that are accurate enough, with all effects that they know.
    pub base: Option<usize>,
    /// The same without each of its effects.
    pub effects: Vec<Single<Switch>>,
    /// The chosen combination; none if no run comes to its end.
    pub chosen: Option<usize>,
}

/// Whether run `i` is accurate enough: within the accuracy with what the reference itself may stray; where that is more than
/// can be told, within twice the stray.
pub fn is_within(bench: &Bench, within: f64, i: usize) -> bool {
    let errors = bench.trials[i].errors.iter().zip(&bench.reference.errors);
    errors.into_iter().all(|(&error, &stray)| {
        let certain = 3.0 * stray <= within;
        if certain { error + stray <= within } else { error <= within.max(2.0 * stray) }
    })
}

/// Searches below the richest scene.
pub fn search(bench: &mut Bench, scene: &Scene, richest: &Richest, within: f64, timed: bool) -> Found {
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
    let mut chosen: Option<usize> = None;
    // the two plainest gears that will do: the richer of both may be cheaper, as its teeth are softer
    for &start in starts.iter().take(STARTS) {
        let reduced = leave_out(bench, start, &effects, scene, within);
        let reduced = loosen(bench, reduced, within);
        if chosen.is_none_or(|best| bench.trials[reduced].cost < CHEAPER * bench.trials[best].cost) {
            chosen = Some(reduced);
        }
    }
    // nothing plainer will do: the reference's own tolerance then
    let chosen = chosen.or_else(|| {
        let scene = bench.reference.scene.clone();
        bench.run(&scene, "the reference").ok()
    });
    let chosen = chosen.map(|chosen| minimal(bench, chosen, &plainer, scene, within));
    let chosen = chosen.map(|chosen| if timed { other_method(bench, chosen, within) } else { chosen });
    Found { rich, gears, base, effects, chosen }
}

/// The run of `scene` on other gears, without the effects that they do not know.
fn on_gears(bench: &mut Bench, gears: Gears, scene: &Scene, what: &str) -> Result<usize, String> {
    let found = gears.of_scene(scene).map_err(|found| super::record::in_one_line(&found))?;
    bench.run(&found.scene, &format!("{what} on gears {}", gears.text()))
}

/// Run `base` without each of its effects.
fn without_each(bench: &mut Bench, base: usize) -> Vec<Single<Switch>> {
    let scene = bench.trials[base].scene.clone();
    let on = effects().filter(|switch| switch.is_on(&scene.parameters));
    on.map(|switch| {
        let off = switch.turned(&scene, false);
        Single { of: switch, run: bench.run(&off, &format!("without {}", switch.name())) }
    })
    .collect()
}

/// Tries whether the chosen setting can do without any one of its parts, again and again until it cannot: its runs are cheap,
/// and those that fail show what is next.
fn minimal(bench: &mut Bench, mut chosen: usize, plainer: &[Gears], written: &Scene, within: f64) -> usize {
    loop {
        let scene = bench.trials[chosen].scene.clone();
        let own = Gears::of(&scene.parameters);
        let on = effects().filter(|switch| switch.is_on(&scene.parameters) && !switch.is_bodies());
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

/// The loosest tolerance at which the richest model is so accurate that others can be judged by it, and its run.
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

/// Leaves effects out of run `start`, those of the least change first, while what remains is accurate enough and cheaper;
/// effects that are off in the scene as `written` leave even where that is dearer: what a scene does not have is not put in to
/// save time.
fn leave_out(bench: &mut Bench, start: usize, singles: &[Single<Switch>], written: &Scene, within: f64) -> usize {
    let size = |bench: &Bench, single: &Single<Switch>| {
        single.run.as_ref().map_or(f64::INFINITY, |&run| bench.trials[run].error())
    };
    let mut left: Vec<&Single<Switch>> =
        singles.iter().filter(|single| single.of.is_on(&bench.trials[start].scene.parameters)).collect();
    left.sort_by(|a, b| size(bench, a).total_cmp(&size(bench, b)));
    let mut current = start;
    // most effects do not matter: all of them at once
    let mut sum = 0.0;
    let base = bench.trials[start].error();
    let few = left.iter().take_while(|single| {
        sum += (size(bench, single) - base).max(0.0);
        sum <= TOGETHER * within
    });
    let few = few.count();
    if few > 1 {
        let mut scene = bench.trials[current].scene.clone();
        left[..few].iter().for_each(|single| single.of.set(&mut scene.parameters, false));
        if let Some(less) = attempt(bench, current, &scene, "without all that do not matter", true, within) {
            current = less;
            left.drain(..few);
        }
    }
    for single in left {
        if single.run.is_ok() && size(bench, single) > HOPELESS * within {
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

/// The run of `scene` if it is accurate enough, and `plainer` or cheaper than run `current`.
fn attempt(bench: &mut Bench, current: usize, scene: &Scene, what: &str, plainer: bool, within: f64) -> Option<usize> {
    if !bench.has_room(bench.trials[current].cost) {
        return None;
    }
    let scene = settled(scene).ok()?.scene;
    let run = bench.run(&scene, what).ok()?;
    let cheaper = bench.trials[run].cost < (1.0 - SAVES) * bench.trials[current].cost;
    ((plainer || cheaper) && is_within(bench, within, run)).then_some(run)
}

/// Loosens the tolerance of run `current` while it stays accurate enough and becomes cheaper.
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

/// Run `chosen` with the method that is fastest, if another one is by far. Counts of different methods cannot be compared:
/// this is a matter of time.
fn other_method(bench: &mut Bench, chosen: usize, within: f64) -> usize {
    let base = bench.trials[chosen].scene.clone();
    let (mut best, mut time) = (chosen, bench.seconds(&base));
    for method in [Method::FixedStep] {
        let mut scene = base.clone();
        scene.parameters.solver.method = method;
        if !bench.has_room(bench.trials[chosen].cost) {
            break;
        }
        let Ok(run) = bench.run(&scene, &format!("method {}", method.literal())) else { continue };
        if !is_within(bench, within, run) || bench.trials[run].effort.seconds > 2.0 * time {
            continue;
        }
        // twice: a machine that is busy for a moment must not decide
        if bench.seconds(&scene) < FASTER * time {
            let best_scene = bench.trials[best].scene.clone();
            let [other, again] = [&scene, &best_scene].map(|scene| bench.seconds(scene));
            if other < FASTER * again {
                (best, time) = (run, other);
            }
        }
    }
    best
}

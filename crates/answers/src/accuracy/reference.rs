//! The reference: the richest model that a scene's question admits, at a tolerance whose own error does not matter.

use anyhow::{Result, anyhow};
use bevel_differential::model::{Method, Parameters};
use bevel_differential::variables::named;

use super::Question;
use super::bench::{Trial, values};
use super::gears::{self, Gears};
use super::price;
use super::record::{Record, in_one_line};
use super::switches::{Status, effects, settled};
use super::want::Want;
use crate::problem::question_error;
use crate::progress::Progress;
use crate::scene::Scene;

/// Tolerance of the first run, as a fraction of the accuracy.
const FIRST: f64 = 1e-4;
/// Maximum tolerance of the first run.
const COARSEST: f64 = 1e-6;
/// Each further pair of runs multiplies the previous tolerance by these factors. Differences of the last three runs are
/// the integrator's error.
const FINER: [f64; 2] = [0.3, 0.1];
/// Tolerances become finer while the reference is uncertain by more than this fraction of the accuracy.
const STEADY: f64 = 0.1;
/// Maximum number of pairs of runs with finer tolerances.
const REFINED: usize = 2;

/// The richest scene, and effects that had to be left out.
pub struct Richest {
    /// The scene.
    pub scene: Scene,
    /// Effects that do not fit the scene, with the reason.
    pub refused: Vec<(&'static str, String)>,
    /// Level and law of the scene.
    pub gears: Gears,
}

/// Returns the scene with the richest gears and all possible effects that influence the wanted outputs.
pub fn richest(scene: &Scene) -> Result<Richest> {
    let gears = gears::richest(scene);
    let mut base = scene.clone();
    // users choose a method for its cost; the reference is adaptive
    base.parameters.solver.method = Method::Adaptive;
    for switch in effects().filter(|switch| switch.status(scene) == Status::NotAsked) {
        switch.set(&mut base.parameters, false);
    }
    let first = gears
        .of_scene(&base)
        .map_err(|found| question_error(format!("scene {}: {}", scene.name, in_one_line(&found))))?;
    let mut refused: Vec<_> = first.without.iter().map(|&name| (name, format!("not with {}", gears.text()))).collect();
    let mut rich = first.scene;
    let candidate = |status| matches!(status, Status::Off) || status == Status::NotAsked;
    for switch in effects().filter(|switch| candidate(switch.status(scene))) {
        let known = switch.is_on(&rich.parameters) || refused.iter().any(|(name, _)| *name == switch.name());
        if known || switch.is_bodies() || switch.status(scene) == Status::NotAsked {
            continue;
        }
        let more = switch.turned(&rich, true);
        match settled(&more) {
            Ok(found) if found.without.is_empty() => rich = found.scene,
            Ok(_) => refused.push((switch.name(), format!("not with {}", gears.text()))),
            Err(found) => refused.push((switch.name(), in_one_line(&found))),
        }
    }
    Ok(Richest { scene: rich, refused, gears })
}

/// Bounds of the relative tolerance.
pub fn tolerances() -> [f64; 2] {
    let row = named("solver.relative_tolerance");
    row.and_then(|row| row.range).map_or([1e-12, 1e-2], |range| [range.min, range.max])
}

/// Returns `p` with another tolerance, clamped to its range.
pub fn at_tolerance(p: &Parameters, tolerance: f64) -> Parameters {
    let [least, most] = tolerances();
    let mut p = *p;
    p.solver.relative_tolerance = tolerance.clamp(least, most);
    p
}

/// Runs the richest scene with finer and finer tolerances until the integrator's error does not matter. Also returns
/// the size of 100 % of each quantity and the cost of the runs.
pub fn run(
    richest: &Scene,
    wants: &[Want],
    question: &Question,
    progress: &mut Progress,
) -> Result<((Trial, Vec<f64>), f64)> {
    let mut tolerance = (FIRST * question.within).min(COARSEST).min(richest.parameters.solver.relative_tolerance);
    let mut at = |tolerance: f64| {
        let scene = Scene { parameters: at_tolerance(&richest.parameters, tolerance), ..richest.clone() };
        progress.begin_task(0.0, &format!("the reference, tolerance {tolerance:.0e}"));
        let record = Record::of(&scene, question.from, f64::INFINITY, progress)
            .map_err(|why| anyhow!("scene {}, with {}: {why}", scene.name, Gears::of(&scene.parameters).text()))?;
        let (values, cost) =
            (values(wants, &record).map_err(question_error)?, price::cost(&scene.parameters, &record.effort));
        let (reason, effort) = ("the reference".into(), record.effort);
        Ok::<_, anyhow::Error>((Trial { scene, reason, values, errors: Vec::new(), effort, cost }, record))
    };
    let (mut last, _) = at(tolerance)?;
    let mut spent = last.cost;
    for refined in 1.. {
        let (between, _) = at(FINER[0] * tolerance)?;
        let (mut finest, record) = at(FINER[1] * tolerance)?;
        tolerance *= FINER[1];
        spent += between.cost + finest.cost;
        let scales = wants.iter().map(|want| want.scale(&finest.scene, &record)).collect::<Result<Vec<f64>, _>>();
        let scales = scales.map_err(question_error)?;
        let stray = |i: usize| {
            let from = |other: &Trial| Want::error(other.values[i], finest.values[i], scales[i]);
            from(&last).max(from(&between))
        };
        finest.errors = (0..wants.len()).map(stray).collect();
        let steady = finest.errors.iter().all(|&stray| stray < STEADY * question.within);
        if steady || refined == REFINED || tolerance <= tolerances()[0] {
            progress.warn(&record.warnings);
            return Ok(((finest, scales), spent));
        }
        last = finest;
    }
    Err(anyhow!("scene {} has no reference", richest.name))
}

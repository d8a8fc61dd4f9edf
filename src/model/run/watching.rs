//! What a completed step adds beside the ledger: loads of the teeth to their fatigue; side speeds and transmission errors to the
//! history of mesh cycles. Both follow the integrator's continuous extension, so that extremes within steps count.

use super::completed_step::Passed;
use crate::integrate::{Curve, Extension, Point, SecondOrder};
use crate::model::assembly::{Model, Watch};
use crate::model::dynamics::{LARGEST, Largest, LastLoads, Watched};
use crate::model::effects::mesh_history::{MOST_QUANTITIES, MeshHistory};
use crate::model::effects::strength::{Fatigue, GearStrength, RatedStep, Rolled, Sample};
use crate::model::scene::layout::LEFT;

/// Adds a completed step to fatigue and history, as far as the scene asks for them.
///
/// Kept out of the loop of steps, so that the loop is the same in every scene.
#[cold]
#[inline(never)]
pub fn watch_step(equations: &Largest, (model, watch): (&Model, &Watch), step: &Passed, watched: &mut Watched) {
    if let Some(strength) = &watch.strength {
        count_fatigue(equations, (model, strength), step, (&mut watched.fatigue, &mut watched.last_loads));
    }
    if watch.keeps_mesh_history {
        add_to_history(equations, model, step, &mut watched.mesh_history);
    }
}

/// Adds a step to the damage of the teeth.
pub fn count_fatigue(
    equations: &Largest,
    (model, strength): (&Model, &GearStrength),
    step: &Passed,
    (fatigue, last): (&mut Fatigue, &mut Option<LastLoads>),
) {
    let Passed { h, begin, extension, part } = step;
    let layout = &equations.teeth.layout;
    let groups = layout.groups;
    let first = layout.planet(0);
    let rolled = |q: &[f64; LARGEST]| {
        let mut rolled = Rolled::default();
        rolled.spin[..groups].copy_from_slice(&q[first..first + groups]);
        rolled
    };
    let mut sample = |fraction: f64, sample: &mut Sample| {
        let at = extension.at(fraction * part);
        (sample.angle, sample.rate) = (rolled(&at.q), rolled(&equations.rates(&at.v)));
        sample.mesh[..groups].fill(Default::default());
        for g in 0..groups {
            equations.pair_loads(&model.pair, &at, g, |s, load| strength.add_load(&mut sample.mesh[g][s], load));
        }
    };
    let from = ((fatigue.from - begin) / h).clamp(0.0, 1.0);
    let members = &layout.members[..groups];
    if from > 0.0 {
        strength.roll(fatigue, members, [&rolled(&extension.start.q), &rolled(&extension.at(from * part).q)]);
    }
    if from < 1.0 {
        let teeth = (groups, equations.is_tooth_broken);
        let are_known =
            last.as_ref().is_some_and(|last| from == 0.0 && last.teeth == teeth && last.at == extension.start);
        let last = last.get_or_insert_default();
        let mut rated = RatedStep { begin: *begin, h: *h, from, members, sample: &mut sample };
        strength.count(fatigue, &mut rated, &mut last.loads, are_known);
        (last.at, last.teeth) = (extension.at(*part), teeth);
    }
}

/// Adds a step to the history: of a step that was cut short, the part that was taken.
pub fn add_to_history(equations: &Largest, model: &Model, step: &Passed, history: &mut MeshHistory) {
    let extension = &step.extension;
    let pitch = model.periods[LEFT];
    let rolling = curve(extension, |at| 0.5 * (at.q[0] - at.q[1]) / pitch);
    let speeds = [0, 1].map(|s| curve(extension, |at| at.v[s]));
    let mesh = &equations.teeth.contact.mesh;
    let error = |g: usize, s: usize| {
        curve(extension, |at| mesh.drive_approach(equations.mesh_state(at, g, s).position[0]) * model.pair.mean_cone)
    };
    let mut quantities = [speeds[0]; MOST_QUANTITIES];
    quantities[1] = speeds[1];
    let count = 2 + 2 * equations.groups();
    for (i, quantity) in quantities[2..count].iter_mut().enumerate() {
        *quantity = error(i / 2, i % 2);
    }
    history.add(&rolling, &quantities[..count], step.part);
}

/// A quantity that depends linearly on the motion.
fn curve(extension: &Extension<LARGEST>, of: impl Fn(&Point<LARGEST>) -> f64) -> Curve {
    let Extension { start, end, coefficients } = extension;
    let nothing = of(&Point::ZERO);
    Curve {
        start: of(start),
        end: of(end),
        coefficients: coefficients.each_ref().map(|coefficient| of(coefficient) - nothing),
    }
}

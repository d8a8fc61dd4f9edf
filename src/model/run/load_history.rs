//! Loads of the teeth along a completed step, as fatigue counts them, by the integrator's continuous extension.

use super::completed_step::Passed;
use crate::integrate::SecondOrder;
use crate::model::assembly::Model;
use crate::model::dynamics::{LARGEST, Largest, LastLoads};
use crate::model::effects::strength::{Fatigue, GearStrength, RatedStep, Rolled, Sample};

/// Adds a step to the damage of the teeth.
pub fn count_fatigue(
    equations: &Largest,
    (model, strength): (&Model, &GearStrength),
    step: &Passed,
    (fatigue, last): (&mut Fatigue, &mut Option<LastLoads>),
) {
    let Passed { h, begin, way, part } = step;
    // of three planets that differ there is a fourth group, without members
    let groups = model.ideal.plan.groups().len();
    let layout = &equations.teeth.layout;
    let first = layout.planet(0);
    let rolled = |q: &[f64; LARGEST]| {
        let mut rolled = Rolled { roll: [q[0], q[1]], ..Rolled::default() };
        rolled.spin[..groups].copy_from_slice(&q[first..first + groups]);
        rolled
    };
    let mut sample = |fraction: f64, sample: &mut Sample| {
        let at = way.at(fraction * part);
        (sample.angle, sample.rate) = (rolled(&at.q), rolled(&equations.rates(&at.v)));
        sample.mesh[..groups].fill(Default::default());
        for g in 0..groups {
            for s in 0..2 {
                equations.pair_loads(&model.pair, &at, g, s, |load| strength.add_load(&mut sample.mesh[g][s], load));
            }
        }
    };
    let from = ((fatigue.from - begin) / h).clamp(0.0, 1.0);
    if from > 0.0 {
        strength.roll(fatigue, &rolled(&way.start.q), &rolled(&way.at(from * part).q));
    }
    if from < 1.0 {
        let members = &layout.members[..groups];
        let teeth = (groups, equations.fault);
        let are_known = last.as_ref().is_some_and(|last| from == 0.0 && last.teeth == teeth && last.at == way.start);
        let last = last.get_or_insert_default();
        let mut rated = RatedStep { begin: *begin, h: *h, from, members, sample: &mut sample };
        strength.count(fatigue, &mut rated, &mut last.loads, are_known);
        (last.at, last.teeth) = (way.at(*part), teeth);
    }
}

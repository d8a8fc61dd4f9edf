//! Loads of the teeth along a completed step, as fatigue counts them, by the integrator's continuous extension.

use super::completed_step::Passed;
use crate::integrate::SecondOrder;
use crate::model::assembly::model::Model;
use crate::model::dynamics::sizes::{LARGEST, Largest};
use crate::model::dynamics::watched::LastLoads;
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
    let mut sample = |fraction: f64| {
        let at = way.at(fraction * part);
        let (angle, rate) = (rolled(&at.q), rolled(&equations.rates(&at.v)));
        let mut sample = Sample { angle, rate, ..Sample::default() };
        for g in 0..groups {
            for s in 0..2 {
                equations.pair_loads(&model.pair, &at, g, s, |load| strength.add_load(&mut sample.mesh[g][s], load));
            }
        }
        sample
    };
    let from = ((fatigue.from - begin) / h).clamp(0.0, 1.0);
    if from > 0.0 {
        strength.roll(fatigue, &rolled(&way.start.q), &rolled(&way.at(from * part).q));
    }
    if from < 1.0 {
        let members = &layout.members[..groups];
        let teeth = (groups, equations.fault);
        let begins = last.as_ref().filter(|last| from == 0.0 && last.teeth == teeth && last.at == way.start);
        let mut rated = RatedStep { begin: *begin, h: *h, from, members, sample: &mut sample };
        let end = strength.count(fatigue, &mut rated, begins.map(|last| &last.loads));
        *last = Some(LastLoads { at: way.at(*part), teeth, loads: end });
    }
}

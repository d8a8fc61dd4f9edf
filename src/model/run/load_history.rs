//! Loads of the teeth along a completed step, as fatigue counts them, by the integrator's continuous extension.

use super::completed_step::{CompletedStep, extension};
use crate::integrate::SecondOrder;
use crate::model::assembly::model::Model;
use crate::model::dynamics::equations::Equations;
use crate::model::effects::strength::{Fatigue, GearStrength, RatedStep, Rolled, Sample};

/// Adds a step to the damage of the teeth; times of steps count from `begin` [s].
pub fn count_fatigue<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool>(
    equations: &Equations<N, G, P, WITH_EFFECTS>,
    (model, strength): (&Model, &GearStrength),
    completed: CompletedStep<N>,
    (begin, fatigue): (f64, &mut Fatigue),
) {
    let (way, part) = extension(equations, completed);
    let step = completed.0;
    // of three planets that differ there is a fourth group, without members
    let groups = model.ideal.plan.groups().len();
    let members: [f64; G] = std::array::from_fn(|g| equations.teeth.layout.members[g]);
    let first = Equations::<N, G, P, WITH_EFFECTS>::PLANET;
    let rolled = |q: &[f64; N]| {
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
    let begin = begin + step.time - step.h;
    let from = ((fatigue.from - begin) / step.h).clamp(0.0, 1.0);
    if from > 0.0 {
        strength.roll(fatigue, &rolled(&step.start.q), &rolled(&way.at(from * part).q));
    }
    if from < 1.0 {
        strength.count(
            fatigue,
            &mut RatedStep { begin, h: step.h, from, members: &members[..groups], sample: &mut sample },
        );
    }
}

//! Loads of the teeth through a completed step, as fatigue counts them: at its end, and where the load of a mesh has a peak in
//! between. Steps end where the solver likes, and a ringing mesh has its peaks elsewhere.

use crate::integrate::{Point, SecondOrder, Step};
use crate::model::assembly::model::Model;
use crate::model::dynamics::equations::Equations;
use crate::model::dynamics::power::Power;
use crate::model::effects::strength::{Fatigue, GearStrength, MeshLoad, RolledStep};

/// Adds a step to the damage of the teeth; times of steps count from `begin` [s].
pub fn count_fatigue<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool>(
    equations: &Equations<N, G, P, WITH_EFFECTS>,
    (model, strength): (&Model, &GearStrength),
    step: &Step<N, Power>,
    (begin, fatigue): (f64, &mut Fatigue),
) {
    let mut peaks: [[f64; 2]; G] = std::array::from_fn(|g| [0, 1].map(|s| peak(equations, step, g, s)));
    let peaks = peaks.as_flattened_mut();
    peaks.sort_unstable_by(f64::total_cmp);
    let members: [f64; G] = std::array::from_fn(|g| equations.teeth.layout.members[g]);
    // of three planets that differ there is a fourth group, without members
    let groups = ..model.ideal.plan.groups().len();
    let first = Equations::<N, G, P, WITH_EFFECTS>::PLANET;
    let (mut last, mut from) = (0.0, *step.start);
    for fraction in peaks.iter().copied().chain([1.0]).filter(|&fraction| fraction > 0.0) {
        if fraction == last {
            continue;
        }
        let at = if fraction == 1.0 { *step.end } else { between(equations, step, fraction) };
        let mut loads = [[MeshLoad::default(); 2]; G];
        for g in 0..G {
            for s in 0..2 {
                equations.pair_loads(&model.pair, &at, g, s, |load| strength.add_load(&mut loads[g][s], load));
            }
        }
        let spin: [f64; G] = std::array::from_fn(|g| at.q[first + g] - from.q[first + g]);
        let roll = [0, 1].map(|s| at.q[s] - from.q[s]);
        let time = begin + step.time - (1.0 - fraction) * step.h;
        let rolled = RolledStep { time, spin: &spin[groups], roll, mesh: &loads[groups], members: &members[groups] };
        strength.count(fatigue, &rolled);
        (last, from) = (fraction, at);
    }
}

/// The fraction of the step after which the approach of a mesh has an extreme; 0 if there is none in between.
fn peak<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool>(
    equations: &Equations<N, G, P, WITH_EFFECTS>,
    step: &Step<N, Power>,
    g: usize,
    s: usize,
) -> f64 {
    let [start, end] = [step.start, step.end].map(|at| equations.mesh_state(at, g, s).rate[0]);
    // false for what is not a number too
    if start * end < 0.0 { start / (start - end) } else { 0.0 }
}

/// The motion after a fraction of the step: positions by the cubic through both ends, velocities in proportion.
fn between<const N: usize, S: SecondOrder<N, Power = Power>>(
    equations: &S,
    step: &Step<N, Power>,
    fraction: f64,
) -> Point<N> {
    let Step { h, start, end, .. } = *step;
    let rates = [start, end].map(|at| equations.rates(&at.v));
    let q = |i: usize| {
        let change = end.q[i] - start.q[i];
        let bends = [h * rates[0][i] - change, change - h * rates[1][i]];
        let bend = (1.0 - fraction) * bends[0] + fraction * bends[1];
        start.q[i] + fraction * (change + (1.0 - fraction) * bend)
    };
    Point { q: std::array::from_fn(q), v: std::array::from_fn(|i| start.v[i] + fraction * (end.v[i] - start.v[i])) }
}

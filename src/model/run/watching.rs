//! Fatigue damage and mesh history of completed steps. Damage follows from the loads of the teeth; the history contains
//! side speeds and transmission errors over mesh cycles. Both use the dense output, so that extremes within steps
//! count. Without dense output, extremes are those at the ends of the steps.

use serde::{Deserialize, Serialize};

use super::completed_step::StepMotion;
use crate::integrate::{Curve, Point, SecondOrder};
use crate::model::assembly::{Model, Watch};
use crate::model::dynamics::{Largest, MAX_SIZE};
use crate::model::effects::mesh_history::{MOST_QUANTITIES, MeshHistory};
use crate::model::effects::strength::{Fatigue, GearStrength, MeshLoad, Rated, RatedStep, Rolled, Sample};
use crate::model::scene::MAX_GROUPS;
use crate::model::scene::layout::LEFT;
use crate::numeric::Finite;

/// Fatigue damage of the teeth, and peak-to-peak values over mesh cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Watched {
    /// Fatigue damage of the teeth.
    pub fatigue: Fatigue,
    /// Peak-to-peak values over mesh cycles.
    pub mesh_history: MeshHistory,
    /// Cache of the loads at the start of the next step. Saved states omit it, because loads follow from the state.
    #[serde(skip)]
    pub last_loads: Option<LastLoads>,
}

/// Loads of the teeth at the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LastLoads {
    /// Point at the end of the step.
    pub at: Point<MAX_SIZE>,
    /// Number of planet groups, and true if a tooth is broken. Together with the point, both determine the loads.
    pub teeth: (usize, bool),
    /// Loads at this point.
    pub loads: Rated,
}

impl Watched {
    /// True if a simulation can continue from these values.
    pub fn is_valid(&self) -> bool {
        // the cache is not saved
        let Self { fatigue, mesh_history, last_loads: _ } = self;
        fatigue.is_finite() && mesh_history.is_valid()
    }
}

/// Adds a completed step to damage and history, if the scene needs them.
///
/// Not inlined, so that the loop over the steps is the same in every scene.
#[cold]
#[inline(never)]
pub fn watch_step(equations: &Largest, (model, watch): (&Model, &Watch), step: &StepMotion, watched: &mut Watched) {
    if let Some(strength) = &watch.strength {
        count_fatigue(equations, (model, strength), step, (&mut watched.fatigue, &mut watched.last_loads));
    }
    if watch.keeps_mesh_history {
        add_to_history(equations, model, step, &mut watched.mesh_history);
    }
}

/// Loads of the meshes, by group and side.
type Meshes = [[MeshLoad; 2]; MAX_GROUPS];

/// Adds a completed step to the damage of the teeth. If only the ends of the step are known, loads within it follow a
/// cubic, limited to the range of the loads at both ends.
pub fn count_fatigue(
    equations: &Largest,
    (model, strength): (&Model, &GearStrength),
    step: &StepMotion,
    (fatigue, last): (&mut Fatigue, &mut Option<LastLoads>),
) {
    let StepMotion { h, begin, extension, accepted_fraction, ends_only } = step;
    let layout = &equations.teeth.layout;
    let groups = layout.groups;
    let first = layout.planet(0);
    let rolled = |q: &[f64; MAX_SIZE]| {
        let mut rolled = Rolled::default();
        rolled.spin[..groups].copy_from_slice(&q[first..first + groups]);
        rolled
    };
    let loads = |at: &Point<MAX_SIZE>, mesh: &mut Meshes| {
        mesh[..groups].fill(Default::default());
        for g in 0..groups {
            equations.pair_loads(&model.pair, at, g, |s, load| strength.add_load(&mut mesh[g][s], load));
        }
    };
    let mut ends = None;
    let mut sample = |fraction: f64, sample: &mut Sample| {
        let at = extension.at(fraction * accepted_fraction);
        (sample.angle, sample.rate) = (rolled(&at.q), rolled(&equations.rates(&at.v)));
        if !ends_only {
            return loads(&at, &mut sample.mesh);
        }
        let [start, end] = ends.get_or_insert_with(|| {
            let mut ends = [Meshes::default(); 2];
            ends.iter_mut().zip([&extension.start, &extension.end]).for_each(|(mesh, at)| loads(at, mesh));
            ends
        });
        if fraction == 1.0 {
            sample.mesh = *end;
            return;
        }
        loads(&at, &mut sample.mesh);
        // the solver has computed no load outside this range
        for g in 0..groups {
            sample.mesh[g] = [0, 1].map(|s| sample.mesh[g][s].within([&start[g][s], &end[g][s]]));
        }
    };
    let from = ((fatigue.from - begin) / h).clamp(0.0, 1.0);
    let members = &layout.members[..groups];
    if from > 0.0 {
        strength.roll(
            fatigue,
            members,
            [&rolled(&extension.start.q), &rolled(&extension.at(from * accepted_fraction).q)],
        );
    }
    if from < 1.0 {
        let teeth = (groups, equations.is_tooth_broken);
        let are_known =
            last.as_ref().is_some_and(|last| from == 0.0 && last.teeth == teeth && last.at == extension.start);
        let last = last.get_or_insert_default();
        let mut rated = RatedStep { begin: *begin, h: *h, from, members, sample: &mut sample };
        strength.count(fatigue, &mut rated, &mut last.loads, are_known);
        (last.at, last.teeth) = (extension.at(*accepted_fraction), teeth);
    }
}

/// Adds a completed step to the mesh history. Only the accepted fraction of its dense output counts. If only the ends of
/// the step are known, quantities follow straight lines.
pub fn add_to_history(equations: &Largest, model: &Model, step: &StepMotion, history: &mut MeshHistory) {
    let pitch = model.periods[LEFT];
    let curve = |of: &dyn Fn(&Point<MAX_SIZE>) -> f64| {
        let curve = Curve::of(&step.extension, of);
        if step.ends_only { Curve::line(curve.start, curve.end) } else { curve }
    };
    let rolling = curve(&|at| 0.5 * (at.q[0] - at.q[1]) / pitch);
    let speeds = [0, 1].map(|s| curve(&|at| at.v[s]));
    let mesh = &equations.teeth.contact.mesh;
    let error = |g: usize, s: usize| {
        curve(&|at| mesh.drive_approach(equations.mesh_state(at, g, s).position[0]) * model.pair.mean_cone)
    };
    let mut quantities = [speeds[0]; MOST_QUANTITIES];
    quantities[1] = speeds[1];
    let count = 2 + 2 * equations.groups();
    for (i, quantity) in quantities[2..count].iter_mut().enumerate() {
        *quantity = error(i / 2, i % 2);
    }
    history.add(&rolling, &quantities[..count], step.accepted_fraction);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damage_that_is_not_finite_is_invalid() {
        assert!(Watched::default().is_valid());
        for bad in [f64::NAN, f64::INFINITY] {
            let mut all = [Watched::default(); 3];
            all[0].fatigue.from = bad;
            all[1].fatigue.planets[1].flanks[0].root.sum = bad;
            all[2].fatigue.utilisation.flank.share = bad;
            assert!(all.iter().all(|watched| !watched.is_valid()), "{bad}");
        }
    }
}

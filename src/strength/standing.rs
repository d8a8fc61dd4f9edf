//! Fatigue of the roots of teeth that stand in mesh.
//!
//! A standing tooth touches with one flank or, when the torque reverses, with the other. The force on its drive flank
//! bends the fillet at that flank into tension and that at the coast flank into compression, a force on the coast flank
//! the other way round. So both fillets have the same history of stress with opposite signs: a cycle of one is a cycle
//! of the other with the mean negated. One rainflow count serves both.

use serde::{Deserialize, Serialize};

use super::mean_stress::pulsating_range;
use super::{Damage, LoadCycle, Rainflow, Rating};

/// Reversals of stress up to this part of the strength are not counted.
const GATE: f64 = 0.01;

/// Damage of a gear's root at the drive and at the coast flank.
type Roots = [Damage; 2];

/// Teeth that stand in the meshes of a side gear: `Copy`, no allocation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StandingTeeth {
    /// Force that bends them, positive on the drive flank [N].
    history: Rainflow,
    /// Damage of closed cycles to planet and side gear.
    roots: [Roots; 2],
}

impl StandingTeeth {
    /// Whether no force has been counted yet.
    pub fn are_new(&self) -> bool {
        self.history.is_empty()
    }

    /// Adds a force on the teeth, positive on the drive flank [N].
    pub fn add_force(&mut self, rating: &Rating, force: f64) {
        let Self { history, roots } = self;
        if history.is_empty() {
            let weakest = rating.root[0].per_force.max(rating.root[1].per_force);
            *history = Rainflow::new(GATE * rating.bending[1].strength / weakest);
        }
        history.push(force, |cycle| count(rating, roots, &cycle));
    }

    /// Other teeth come into mesh, with a history of their own.
    pub fn next_teeth(&mut self, rating: &Rating) {
        let Self { history, roots } = self;
        history.rest(|cycle| count(rating, roots, &cycle));
        *history = Rainflow::default();
    }

    /// Damage sums of the worse root of planet and side gear. Cycles that are still open count as the halves that they
    /// are, so that the sum does not depend on rounding of two equal peaks.
    pub fn worst_sums(&self, rating: &Rating) -> [f64; 2] {
        let mut roots = self.roots;
        self.history.rest(|cycle| count(rating, &mut roots, &cycle));
        roots.map(|[drive, coast]| drive.sum.max(coast.sum))
    }
}

fn count(rating: &Rating, roots: &mut [Roots; 2], cycle: &LoadCycle) {
    for (root, roots) in rating.root.iter().zip(roots) {
        for (damage, mean) in roots.iter_mut().zip([cycle.mean, -cycle.mean]) {
            let range = pulsating_range(&LoadCycle { mean, ..*cycle }, rating.sensitivity);
            // the mean stress is counted as it is: the planet's idler strength is for teeth that roll
            damage.add(&rating.bending[1], root.stress(range), cycle.count);
        }
    }
}

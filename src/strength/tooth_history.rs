//! Load history and damage of one tooth: the stress of both roots through all meshes, and the passages of both flanks.
//!
//! A force on a flank causes tension in the fillet at this flank and compression in the other fillet. Both fillets
//! therefore have the same stress history with opposite signs: a cycle of one is a cycle of the other with the mean
//! negated. One rainflow count serves both. Outside the mesh the stress is 0. The tooth of a planet meets both side
//! gears on opposite flanks, so its cycles range from one to the other; a tooth that meets only one of them pulsates.
//!
//! Cycles that are still open count as halves. The sum then does not depend on the rounding of two equal peaks.

use serde::{Deserialize, Serialize};

use super::mean_stress::pulsating_range;
use super::{LoadCycle, Rainflow, SnCurve};
use crate::numeric::finite;

/// Fraction of the strength up to which reversals of stress are not counted.
const GATE: f64 = 0.01;

/// Bending strength of a tooth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bending {
    /// S–N curve for pulsating load.
    pub curve: SnCurve,
    /// Sensitivity M to mean stress.
    pub sensitivity: f64,
}

impl Bending {
    /// Stress [Pa] of the pulsating cycle that does the same damage as `cycle`, in the fillet at flank 0 and in the
    /// other fillet.
    fn pulsating(&self, cycle: &LoadCycle) -> [f64; 2] {
        [cycle.mean, -cycle.mean].map(|mean| pulsating_range(&LoadCycle { mean, ..*cycle }, self.sensitivity))
    }

    /// Adds the damage of `weight` times `cycle` to the `roots`. Returns the larger pulsating stress of both fillets
    /// [Pa].
    fn count(&self, roots: &mut [f64; 2], cycle: &LoadCycle, weight: f64) -> f64 {
        let stresses = self.pulsating(cycle);
        for (root, stress) in roots.iter_mut().zip(stresses) {
            *root += weight * cycle.count * self.curve.damage_per_cycle(stress);
        }
        stresses[0].max(stresses[1])
    }
}

/// Load history and damage of one tooth. The type is `Copy` and allocates nothing.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct ToothHistory {
    /// Root stress, positive under load on flank 0 [Pa].
    stress: Rainflow,
    /// Miner sums of both roots by closed cycles.
    closed: [f64; 2],
    /// Miner sums of both flanks.
    flanks: [f64; 2],
    /// Damage of the roots as last computed; `None` after a change.
    #[serde(skip)]
    known: Option<RootDamage>,
}

/// Damage of the roots of a tooth, open cycles included.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RootDamage {
    /// Miner sums of both roots.
    pub sums: [f64; 2],
    /// Largest stress [Pa] of a pulsating cycle that does the damage of an open cycle.
    pub largest_open: f64,
}

finite!(ToothHistory { stress, closed, flanks; known });

impl PartialEq for ToothHistory {
    /// Compares what does not follow from the rest.
    fn eq(&self, other: &Self) -> bool {
        (&self.stress, self.closed, self.flanks) == (&other.stress, other.closed, other.flanks)
    }
}

impl ToothHistory {
    /// Returns a tooth without load under the strength `bending`.
    pub fn new(bending: &Bending) -> Self {
        Self { stress: Rainflow::new(GATE * bending.curve.strength), ..Self::default() }
    }

    /// True if the tooth is in mesh and loaded.
    pub fn is_loaded(&self) -> bool {
        self.stress.last() != 0.0
    }

    /// Adds a root `stress` [Pa], positive under load on flank 0. The cycles that it closes count `weight` times.
    /// Returns the largest stress [Pa] of a pulsating cycle that does the damage of one of these cycles, 0 without
    /// cycles.
    pub fn bend(&mut self, bending: &Bending, stress: f64, weight: f64) -> f64 {
        let (closed, mut largest) = (&mut self.closed, 0.0f64);
        self.known = None;
        self.stress.push(stress, |cycle| largest = largest.max(bending.count(closed, &cycle, weight)));
        largest
    }

    /// Counts a passage of the contact over the rated point of `flank` with its `damage`.
    pub fn pass(&mut self, flank: usize, damage: f64) {
        self.flanks[flank & 1] += damage;
    }

    /// Damage of the roots.
    pub fn roots(&self, bending: &Bending) -> RootDamage {
        self.known.unwrap_or_else(|| {
            let (mut sums, mut largest_open) = (self.closed, 0.0f64);
            self.stress.rest(|cycle| largest_open = largest_open.max(bending.count(&mut sums, &cycle, 1.0)));
            RootDamage { sums, largest_open }
        })
    }

    /// Remembers the damage of the roots until the next change.
    pub fn remember(&mut self, bending: &Bending) {
        self.known = Some(self.roots(bending));
    }

    /// Miner sums of both flanks.
    pub fn flanks(&self) -> [f64; 2] {
        self.flanks
    }
}

/// Number (0 or 1) of the flank of a gear's tooth that a mesh loads.
///
/// A side gear has one mesh position, `far` = false. A planet has two, the left (`far` = false) and the right one
/// (`far` = true), which load opposite flanks if both drive. `driving` is true if the carrier drives the side gear.
pub fn loaded_flank(far: bool, driving: bool) -> usize {
    usize::from(far == driving)
}

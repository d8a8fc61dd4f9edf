//! Load cycles of a tooth while it is in mesh, and the damage that they cause to its roots.
//!
//! A tooth in mesh touches with one flank or, if the torque reverses, with the other. A force on its drive flank causes
//! tension in the fillet at that flank and compression in the fillet at the coast flank. A force on the coast flank
//! does the opposite. Both fillets therefore have the same stress history with opposite signs: a cycle of one is a
//! cycle of the other with the mean negated. One rainflow count serves both.
//!
//! A tooth that rolls through its mesh enters and leaves without load, so all its cycles close. The largest of them is
//! the passage itself, which is counted separately ([`super::ToothDamage`]). A cycle only closes inside a range that is
//! at least as large, so the largest cycle stays open until the tooth leaves. All cycles of a tooth that stays in mesh
//! count. Its open cycles count as halves, so that the sum does not depend on rounding of two equal peaks.

use serde::{Deserialize, Serialize};

use super::mean_stress::pulsating_range;
use super::{Damage, LoadCycle, Rainflow, Rating};
use crate::numeric::finite;

/// Fraction of the strength up to which reversals of stress are not counted.
const GATE: f64 = 0.01;

/// Damage of planet and side gear, each at the root of the drive flank and of the coast flank.
pub type RootSums = [[f64; 2]; 2];

/// Load history and damage of a tooth in mesh. The type is `Copy` and allocates nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Passage {
    /// Force that bends the tooth, positive on the drive flank [N].
    history: Rainflow,
    /// Damage of closed cycles.
    roots: [[Damage; 2]; 2],
}

finite!(Passage { history, roots });

impl Passage {
    /// Returns a tooth that enters the mesh while the gears roll on.
    pub fn rolling(rating: &Rating) -> Self {
        let mut passage = Self { history: Rainflow::returning(gate(rating)), ..Self::default() };
        passage.add_force(rating, 0.0);
        passage
    }

    /// True if no force has been counted yet.
    pub fn is_new(&self) -> bool {
        self.history.is_empty()
    }

    /// Adds a force on the tooth, positive on the drive flank [N].
    pub fn add_force(&mut self, rating: &Rating, force: f64) {
        let Self { history, roots } = self;
        if history.is_empty() && !history.returns() {
            *history = Rainflow::new(gate(rating));
        }
        history.push(force, |cycle| count(rating, roots, cycle));
    }

    /// Damage of the tooth if it leaves the mesh now.
    pub fn sums(&self, rating: &Rating) -> RootSums {
        let Self { history, mut roots } = *self;
        if history.returns() {
            let mut largest = None;
            history.rest_of_return(|cycle| {
                if let Some(smaller) = beside_largest(&mut largest, cycle) {
                    count(rating, &mut roots, smaller);
                }
            });
        } else {
            history.rest(|cycle| count(rating, &mut roots, cycle));
        }
        roots.map(|flanks| flanks.map(|damage| damage.sum))
    }
}

/// Smallest reversal of force that counts [N].
fn gate(rating: &Rating) -> f64 {
    let weakest = rating.root[0].per_force.max(rating.root[1].per_force);
    GATE * rating.bending[1].strength / weakest
}

/// Keeps the larger of two cycles and returns the other.
fn beside_largest(largest: &mut Option<LoadCycle>, cycle: LoadCycle) -> Option<LoadCycle> {
    match largest {
        Some(known) if known.range >= cycle.range => Some(cycle),
        _ => largest.replace(cycle),
    }
}

fn count(rating: &Rating, roots: &mut [[Damage; 2]; 2], cycle: LoadCycle) {
    for (root, roots) in rating.root.iter().zip(roots) {
        for (damage, mean) in roots.iter_mut().zip([cycle.mean, -cycle.mean]) {
            let range = pulsating_range(&LoadCycle { mean, ..cycle }, rating.sensitivity);
            // the mean stress is counted explicitly: the planet's idler strength is for teeth that roll
            damage.add(&rating.bending[1], root.stress(range), cycle.count);
        }
    }
}

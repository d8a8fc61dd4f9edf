//! Damage of the teeth of a running differential.

use serde::{Deserialize, Serialize};

use super::overload::Overloads;
use super::utilisation::Utilisation;
use crate::model::scene::MAX_GROUPS;
use crate::numeric::finite;
use crate::strength::{Damage, FlankDamage, Rating, TeethInMesh, ToothDamage};

/// Damage of the teeth so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fatigue {
    /// Planets, by group.
    pub planets: [ToothDamage; MAX_GROUPS],
    /// Side gears.
    pub sides: [ToothDamage; 2],
    /// Swings of the load while teeth are in mesh.
    pub in_mesh: TeethInMesh,
    /// Stresses that exceeded their strength.
    pub overloads: Overloads,
    /// Largest ratios of stress to strength.
    pub utilisation: Utilisation,
    /// Time from which damage and stresses count [s].
    pub from: f64,
    /// True if the run did not start in equilibrium, and damage and stresses count from this start.
    pub counts_start: bool,
}

finite!(Fatigue { planets, sides, in_mesh, overloads, utilisation, from; counts_start });

impl Fatigue {
    /// Damage of a run that begins at `start` [s] and is rated from `later` [s] after that. `in_equilibrium` is true if
    /// the run begins in equilibrium.
    pub fn new(start: f64, later: f64, in_equilibrium: bool) -> Self {
        Self { from: start + later, counts_start: later == 0.0 && !in_equilibrium, ..Self::default() }
    }

    /// Mean damage per cycle so far: of the worst planet's root, the worse side gear's root, and the worst flank.
    pub fn worst_per_cycle(&self) -> [f64; 3] {
        let worst = |gears: &[ToothDamage], of: fn(&FlankDamage) -> &Damage| {
            gears.iter().flat_map(|gear| &gear.flanks).map(|flank| of(flank).per_cycle()).fold(0.0, f64::max)
        };
        let pitting = |gears| worst(gears, |flank| &flank.pitting);
        [
            worst(&self.planets, |flank| &flank.root),
            worst(&self.sides, |flank| &flank.root),
            pitting(&self.planets).max(pitting(&self.sides)),
        ]
    }

    /// Damage sums of the worst teeth: roots of the worst planet and side gear, then their flanks. `planets` is the
    /// number of planets.
    pub fn sums(&self, rating: &Rating, planets: usize) -> [f64; 4] {
        let worst = |gears: &[ToothDamage], of: fn(&ToothDamage) -> f64| gears.iter().map(of).fold(0.0, f64::max);
        let root = |gear: &ToothDamage, swings: [f64; 2]| {
            let [one, other] = &gear.flanks;
            (one.root.sum + swings[0]).max(other.root.sum + swings[1])
        };
        let (of_planets, of_sides) = self.in_mesh.worst(rating, planets);
        [
            self.planets.iter().map(|planet| root(planet, of_planets)).fold(0.0, f64::max),
            self.sides.iter().zip(of_sides).map(|(side, swings)| root(side, swings)).fold(0.0, f64::max),
            worst(&self.planets, ToothDamage::worst_pitting),
            worst(&self.sides, ToothDamage::worst_pitting),
        ]
    }
}

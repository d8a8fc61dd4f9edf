//! Load swings while teeth are in mesh, counted tooth by tooth.
//!
//! Each tooth has the damage of its own passages. A planet's tooth meshes once per revolution with each side gear, on
//! opposite flanks. In a side gear, one tooth meshes with each planet. All planets count as equal, and so do the teeth
//! of a side gear that are in mesh at an instant: the most heavily loaded mesh of a side represents all.

use serde::{Deserialize, Serialize};

use super::interval::{Three, at, extremum};
use super::passage::RootSums;
use super::{MeshPlace, Passage, Rating, ToothSums, loaded_flank};
use crate::numeric::finite;

/// Damage of the teeth of planets and side gears. The type is `Copy` and allocates nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TeethInMesh {
    /// Position of the gears, which determines the teeth in mesh.
    place: MeshPlace,
    /// Passages of the teeth in mesh with the left and with the right side gear.
    passages: [Passage; 2],
    /// Damage of the planets' teeth from finished passages.
    planets: ToothSums,
    /// Damage of the side gears' teeth from finished passages.
    sides: [ToothSums; 2],
}

finite!(TeethInMesh { place, passages, planets, sides });

impl TeethInMesh {
    /// Rolls the planets by `angle` [rad] without counting.
    pub fn roll(&mut self, rating: &Rating, angle: f64) {
        if self.place.advance(angle / rating.pitch[0]).is_some() {
            self.passages = Default::default();
        }
    }

    /// Counts an interval in which `planets` planets roll by `angle` [rad]. `forces` [N] bend the teeth of each side at
    /// the start, in the middle and at the end of the interval, positive on the drive flank.
    pub fn add(&mut self, rating: &Rating, planets: usize, angle: f64, forces: [Three; 2]) {
        let before = self.place;
        let change = self.place.advance(angle / rating.pitch[0]);
        for (side, forces) in forces.into_iter().enumerate() {
            let passage = &mut self.passages[side];
            if passage.is_new() {
                passage.add_force(rating, forces[0]);
            }
            let turn = extremum(forces);
            let ends = change.map_or(1.0, |change| change.leaves);
            if let Some((force, _)) = turn.filter(|turn| turn.1 < ends) {
                passage.add_force(rating, force);
            }
            passage.add_force(rating, at(forces, ends));
            let Some(change) = change else { continue };
            let sums = passage.sums(rating);
            *passage = if change.rolls_on { Passage::rolling(rating) } else { Passage::default() };
            passage.add_force(rating, at(forces, change.enters));
            if let Some((force, _)) = turn.filter(|turn| turn.1 > change.enters) {
                passage.add_force(rating, force);
            }
            passage.add_force(rating, forces[2]);
            self.planets.add(planet_tooth(&before, rating, side), planet_roots(&sums, side));
            for tooth in side_teeth(&before, rating, planets) {
                self.sides[side].add(tooth, sums[1]);
            }
        }
    }

    /// Largest damage of a planet's tooth and of a tooth of each side gear, at the root of each flank. Flanks are
    /// numbered as in [`loaded_flank`].
    pub fn worst(&self, rating: &Rating, planets: usize) -> (RootSum, [RootSum; 2]) {
        let open = self.passages.map(|passage| passage.sums(rating));
        let mut worst = (self.planets.worst(), self.sides.map(|side| side.worst()));
        for (side, sums) in open.iter().enumerate() {
            let tooth = self.planets.of(planet_tooth(&self.place, rating, side));
            raise(&mut worst.0, tooth, planet_roots(sums, side));
            for tooth in side_teeth(&self.place, rating, planets) {
                raise(&mut worst.1[side], self.sides[side].of(tooth), sums[1]);
            }
        }
        worst
    }
}

/// Damage of a tooth at its two roots.
pub type RootSum = [f64; 2];

fn raise(worst: &mut RootSum, known: RootSum, more: RootSum) {
    for root in 0..2 {
        worst[root] = worst[root].max(known[root] + more[root]);
    }
}

/// Tooth of the planets in mesh with side gear `side`. The tooth in mesh with the other side gear is half a revolution
/// away.
fn planet_tooth(place: &MeshPlace, rating: &Rating, side: usize) -> (usize, usize) {
    place.tooth_of(rating.teeth[0], side * (rating.teeth[0] / 2))
}

/// Teeth of a side gear in mesh with the planets.
fn side_teeth(place: &MeshPlace, rating: &Rating, planets: usize) -> impl Iterator<Item = (usize, usize)> {
    let (place, teeth) = (*place, rating.teeth[1]);
    (0..planets).map(move |planet| place.tooth_of(teeth, planet * teeth / planets))
}

/// Damage of a planet's tooth by flank. Passages with the two side gears load opposite flanks.
fn planet_roots(sums: &RootSums, side: usize) -> RootSum {
    let [drive, coast] = sums[0];
    let mut roots = [0.0; 2];
    roots[loaded_flank(side == 1, true)] = drive;
    roots[loaded_flank(side == 1, false)] = coast;
    roots
}

//! Damage of the teeth of a running differential: the history of each tooth, and the largest stresses.
//!
//! The histories are in memory that is allocated once, at the start. A step that is rejected, or that is completed only
//! to read outputs, is taken back: the histories that it changed were copied before.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::mesh_load::Sample;
use super::overload::{Overload, Overloads, Stressed};
use super::utilisation::Utilisation;
use crate::integrate::Point;
use crate::model::dynamics::MAX_SIZE;
use crate::model::effect_kinds::Memory;
use crate::model::scene::MAX_GROUPS;
use crate::numeric::{Finite, finite};
use crate::strength::{Bending, RatedPoint, Rating, ToothHistory, ToothInMesh};

/// Rolling of the planets of a group in the mesh with one side gear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeshRolling {
    /// Passages over the rated points of drive and coast flanks.
    pub rated: [RatedPoint; 2],
    /// Tooth in mesh, if one spring represents the whole mesh.
    pub in_mesh: ToothInMesh,
}

/// Everything of the damage but the histories of the teeth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Rolling in the meshes, by group of planets and side.
    pub meshes: [[MeshRolling; 2]; MAX_GROUPS],
    /// Stresses that exceeded their strength.
    pub overloads: Overloads,
    /// Largest ratios of stress to strength.
    pub utilisation: Utilisation,
    /// Largest root stress so far [Pa].
    pub largest_stress: f64,
    /// Time from which damage and stresses count [s].
    pub from: f64,
    /// True if the run did not start in equilibrium, and damage and stresses count from this start.
    pub counts_start: bool,
}

finite! {
    MeshRolling { rated, in_mesh }
    Tally { meshes, overloads, utilisation, largest_stress, from; counts_start }
}

impl Tally {
    /// Records a `load` if it is the first of its kind above the strength, or has the largest ratio of stress to
    /// strength.
    pub fn watch(&mut self, what: Stressed, load: Overload) {
        self.overloads.watch(what, load);
        self.utilisation.watch(what, &load);
    }
}

/// Loads of the teeth at the end of a step: a cache for the start of the next one. Saved states omit it, because loads
/// follow from the state.
#[derive(Clone, Copy, Debug, Default)]
pub struct LastLoads {
    /// Point at the end of the step.
    pub at: Point<MAX_SIZE>,
    /// Number of planet groups, 0 without loads, and true if a tooth is broken. Together with the point, both determine
    /// the loads.
    pub teeth: (usize, bool),
    /// Loads at this point.
    pub loads: Sample,
}

/// Damage of the teeth so far.
#[derive(Debug)]
pub struct Fatigue {
    /// Everything but the histories.
    pub tally: Tally,
    /// The tally at the last checkpoint.
    tally_before: Tally,
    teeth: Vec<ToothHistory>,
    /// Histories before their first change since the last checkpoint, with their indices.
    undo: Vec<(usize, ToothHistory)>,
    /// For each tooth, the number of the checkpoint after which it last changed.
    changed: Vec<u64>,
    /// Number of the last checkpoint.
    checkpoint: u64,
    /// Numbers of teeth of planet and side gear.
    counts: [usize; 2],
    /// Loads at the end of the last step; `None` only while they are in use.
    pub last_loads: Option<Box<LastLoads>>,
    /// These loads at the last checkpoint.
    last_loads_before: Box<LastLoads>,
}

impl Fatigue {
    /// Damage of the gears of `rating` with `groups` groups of planets, in a run that begins at `start` [s] and is rated
    /// from `later` [s] after that. `in_equilibrium` is true if the run begins in equilibrium.
    pub fn new(rating: &Rating, groups: usize, (start, later): (f64, f64), in_equilibrium: bool) -> Self {
        let counts_start = later == 0.0 && !in_equilibrium;
        let tally = Tally { from: start + later, counts_start, ..Tally::default() };
        let [planet, side] = rating.teeth;
        Self::of(tally, vec![ToothHistory::new(&rating.bending); groups * planet + 2 * side], rating.teeth)
    }

    fn of(tally: Tally, teeth: Vec<ToothHistory>, counts: [usize; 2]) -> Self {
        let (undo, changed) = (Vec::with_capacity(teeth.len()), vec![0; teeth.len()]);
        let (last_loads, last_loads_before) = (Some(Box::default()), Box::default());
        let tally_before = tally;
        Self { tally, tally_before, teeth, undo, changed, checkpoint: 1, counts, last_loads, last_loads_before }
    }

    /// Index of a planet's tooth, by group of planets.
    pub fn of_planet(&self, group: usize, tooth: usize) -> usize {
        group * self.counts[0] + tooth
    }

    /// Index of a side gear's tooth. The number of the tooth may be any number of turns too large.
    pub fn of_side(&self, side: usize, tooth: usize) -> usize {
        self.teeth.len() - (2 - side) * self.counts[1] + tooth % self.counts[1].max(1)
    }

    /// Number of teeth.
    pub fn count(&self) -> usize {
        self.teeth.len()
    }

    /// History of a tooth.
    pub fn tooth(&self, index: usize) -> &ToothHistory {
        &self.teeth[index]
    }

    /// History of a tooth, to be changed.
    pub fn tooth_mut(&mut self, index: usize) -> &mut ToothHistory {
        let tooth = &mut self.teeth[index];
        if self.changed[index] != self.checkpoint {
            self.changed[index] = self.checkpoint;
            self.undo.push((index, *tooth));
        }
        tooth
    }

    /// Remembers the damage of all roots, so that it is computed only once after each change.
    pub fn remember(&mut self, bending: &Bending) {
        self.teeth.iter_mut().for_each(|tooth| tooth.remember(bending));
    }

    /// Miner sums of the worst teeth: roots of planets and side gears, then their flanks. Also the largest stress [Pa]
    /// of a pulsating cycle that does the damage of a cycle that is still open.
    pub fn worst(&self, bending: &Bending) -> ([f64; 4], f64) {
        let (mut sums, mut largest) = ([0.0f64; 4], 0.0f64);
        let sides = self.of_side(0, 0);
        for (index, tooth) in self.teeth.iter().enumerate() {
            let roots = tooth.roots(bending);
            let gear = usize::from(index >= sides);
            for (sum, of) in [(gear, roots.sums), (2 + gear, tooth.flanks())] {
                sums[sum] = sums[sum].max(of[0]).max(of[1]);
            }
            largest = largest.max(roots.largest_open);
        }
        (sums, largest)
    }
}

impl Memory for Fatigue {
    type Checkpoint = ();

    fn checkpoint(&mut self) {
        self.tally_before = self.tally;
        self.last_loads.iter().for_each(|loads| *self.last_loads_before = **loads);
        self.checkpoint += 1;
        self.undo.clear();
    }

    fn roll_back(&mut self, (): ()) {
        self.tally = self.tally_before;
        self.last_loads.iter_mut().for_each(|loads| **loads = *self.last_loads_before);
        for (index, tooth) in self.undo.drain(..) {
            self.teeth[index] = tooth;
        }
        self.checkpoint += 1;
    }

    fn is_valid(&self) -> bool {
        self.is_finite()
    }

    /// True if both belong to the same gears.
    fn fits(&self, start: &Self) -> bool {
        (self.counts, self.teeth.len()) == (start.counts, start.teeth.len())
    }

    fn tuned(&mut self) {
        self.last_loads.iter_mut().for_each(|loads| **loads = LastLoads::default());
    }
}

impl Clone for Fatigue {
    /// Copies the damage. The copy has its own memory for checkpoints.
    fn clone(&self) -> Self {
        Self::of(self.tally, self.teeth.clone(), self.counts)
    }
}

impl PartialEq for Fatigue {
    fn eq(&self, other: &Self) -> bool {
        (&self.tally, &self.teeth, self.counts) == (&other.tally, &other.teeth, other.counts)
    }
}

impl Finite for Fatigue {
    fn is_finite(&self) -> bool {
        self.tally.is_finite() && self.teeth.iter().all(Finite::is_finite)
    }
}

impl Serialize for Fatigue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (&self.tally, &self.teeth, self.counts).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Fatigue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (tally, teeth, counts) = Deserialize::deserialize(deserializer)?;
        Ok(Self::of(tally, teeth, counts))
    }
}

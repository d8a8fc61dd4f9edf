//! Load of a mesh, from which the strength of its teeth is rated.

use crate::contact::Flank;

/// Maximum number of loaded pairs of a mesh. With a contact ratio below 3, a flank has at most three pairs on its path.
const MOST_PAIRS: usize = 6;

/// Load of one flank of a mesh: sums over its pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlankLoad {
    /// Normal force [N], as if it acted at the cone distance at which the law's resultant acts under an even load.
    pub normal: f64,
    /// Normal force as in `normal`, but with each pair's force multiplied by its face load factor K_Hβ [N]. The rated
    /// contact pressure follows from it.
    pub normal_face_loaded: f64,
    /// Largest pressure of a pair [Pa].
    pub pressure: f64,
}

/// Stress at the roots of a tooth pair.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BentPair {
    /// True if the drive flanks touch.
    pub drives: bool,
    /// Numbers of the planet's and the side gear's tooth, from 0. If one spring represents the mesh, it has no teeth.
    pub teeth: [usize; 2],
    /// Root stress of the planet's and the side gear's tooth [Pa].
    pub stress: [f64; 2],
}

/// Load of one mesh. Both flanks are loaded at the same time only if errors or displacements use up the backlash.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshLoad {
    flanks: [FlankLoad; 2],
    pairs: [BentPair; MOST_PAIRS],
    count: usize,
}

impl MeshLoad {
    /// Removes the load. Pairs beyond the count keep their values, because clearing them costs more than their use.
    pub fn clear(&mut self) {
        (self.flanks, self.count) = (Default::default(), 0);
    }

    /// Load of a flank.
    pub fn flank(&mut self, flank: Flank) -> &mut FlankLoad {
        &mut self.flanks[usize::from(flank == Flank::Coast)]
    }

    /// Loads of the drive flank and the coast flank.
    pub fn flanks(&self) -> &[FlankLoad; 2] {
        &self.flanks
    }

    /// Adds a pair. If there are too many, those with the largest stress stay.
    pub fn add_pair(&mut self, pair: BentPair) {
        if self.count < MOST_PAIRS {
            self.pairs[self.count] = pair;
            self.count += 1;
        } else if let Some(least) = self.pairs.iter_mut().min_by(|a, b| a.stress[0].total_cmp(&b.stress[0]))
            && least.stress[0] < pair.stress[0]
        {
            *least = pair;
        }
    }

    /// Loaded pairs.
    pub fn pairs(&self) -> &[BentPair] {
        &self.pairs[..self.count]
    }

    /// Larger value of `of` over both flanks.
    pub fn largest(&self, of: impl Fn(&FlankLoad) -> f64) -> f64 {
        let [drive, coast] = &self.flanks;
        of(drive).max(of(coast))
    }

    /// Largest root stress of gear `i` (0 planet, 1 side gear) [Pa].
    pub fn root_stress(&self, i: usize) -> f64 {
        self.pairs().iter().map(|pair| pair.stress[i]).fold(0.0, f64::max)
    }
}

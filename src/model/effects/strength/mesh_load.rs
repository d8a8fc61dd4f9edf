//! Load of a mesh, from which the strength of its teeth is rated, for each flank.

use crate::contact::Flank;

/// Load of one flank of a mesh: sums over its pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlankLoad {
    /// Normal force [N], as if it acted at the cone distance at which the law's resultant acts under an even load.
    pub normal: f64,
    /// Normal force as in `normal`, but with each pair's force multiplied by its face load factor K_Hβ [N]. The rated
    /// contact pressure follows from it.
    pub normal_face_loaded: f64,
    /// Normal force [N], as if it acted at the mean cone distance, with each pair's force multiplied by K_Fβ. The root
    /// stress follows from it.
    pub bending: f64,
    /// Largest pressure of a pair [Pa].
    pub pressure: f64,
}

/// Load of one mesh. Both flanks are loaded at the same time only if errors or displacements use up the backlash.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshLoad {
    flanks: [FlankLoad; 2],
}

impl FlankLoad {
    /// Load at the fraction `part` of the straight line from this load to `end`.
    fn toward(&self, end: &Self, part: f64) -> Self {
        let between = |of: fn(&Self) -> f64| (1.0 - part) * of(self) + part * of(end);
        Self {
            normal: between(|load| load.normal),
            normal_face_loaded: between(|load| load.normal_face_loaded),
            bending: between(|load| load.bending),
            pressure: between(|load| load.pressure),
        }
    }
}

impl MeshLoad {
    /// Load at the fraction `part` of the straight line from this load to `end`.
    pub fn toward(&self, end: &Self, part: f64) -> Self {
        Self { flanks: [0, 1].map(|flank| self.flanks[flank].toward(&end.flanks[flank], part)) }
    }

    /// Load of a flank.
    pub fn flank(&mut self, flank: Flank) -> &mut FlankLoad {
        &mut self.flanks[usize::from(flank == Flank::Coast)]
    }

    /// Loads of the drive flank and the coast flank.
    pub fn flanks(&self) -> &[FlankLoad; 2] {
        &self.flanks
    }

    /// Larger value of `of` over both flanks.
    pub fn largest(&self, of: impl Fn(&FlankLoad) -> f64) -> f64 {
        let [drive, coast] = &self.flanks;
        of(drive).max(of(coast))
    }

    /// Force that bends the teeth, positive on the drive flank [N].
    pub fn bending(&self) -> f64 {
        self.flanks[0].bending - self.flanks[1].bending
    }
}

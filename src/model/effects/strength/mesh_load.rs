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
    /// This load, with each value limited to the range between the values of two other loads.
    fn within(&self, [one, other]: [&Self; 2]) -> Self {
        let limited = |of: fn(&Self) -> f64| of(self).max(of(one).min(of(other))).min(of(one).max(of(other)));
        Self {
            normal: limited(|load| load.normal),
            normal_face_loaded: limited(|load| load.normal_face_loaded),
            bending: limited(|load| load.bending),
            pressure: limited(|load| load.pressure),
        }
    }
}

impl MeshLoad {
    /// This load, with each value of both flanks limited to the range between the values of two other loads.
    pub fn within(&self, ends: [&Self; 2]) -> Self {
        Self { flanks: [0, 1].map(|flank| self.flanks[flank].within(ends.map(|end| &end.flanks[flank]))) }
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

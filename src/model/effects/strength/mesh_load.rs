//! Load of a mesh as its strength is rated, flank by flank.

use crate::contact::Flank;

/// Load of one flank of a mesh: sums over its pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlankLoad {
    /// Normal force at the cone distance of the law's resultant [N].
    pub normal: f64,
    /// The same, each pair's times its face load factor K_Hβ: what the pressure follows [N].
    pub pressing: f64,
    /// Normal force at the mean cone distance, each pair's times K_Fβ: what bends the roots [N].
    pub bending: f64,
    /// Largest pressure of a pair [Pa].
    pub pressure: f64,
}

/// Load of one mesh. Both flanks carry at once only where errors or displacements use up the backlash.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshLoad {
    flanks: [FlankLoad; 2],
}

impl MeshLoad {
    /// Load of a flank.
    pub fn flank(&mut self, flank: Flank) -> &mut FlankLoad {
        &mut self.flanks[usize::from(flank == Flank::Coast)]
    }

    /// Loads of the drive flank and the coast flank.
    pub fn flanks(&self) -> &[FlankLoad; 2] {
        &self.flanks
    }

    /// Largest value of `of` of both flanks.
    pub fn largest(&self, of: impl Fn(&FlankLoad) -> f64) -> f64 {
        let [drive, coast] = &self.flanks;
        of(drive).max(of(coast))
    }

    /// Force that bends the teeth, positive from the drive flank [N].
    pub fn bending(&self) -> f64 {
        self.flanks[0].bending - self.flanks[1].bending
    }
}

//! Load of a mesh as its strength is rated.

use super::gear_strength::GearStrength;
use crate::contact::pairs::Flank;
use crate::contact::tooth_load::ToothLoad;

/// Load of one mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshLoad {
    /// Sum of normal forces referred to the mean cone distance [N].
    pub normal: f64,
    /// Largest pressure of a pair [Pa].
    pub pressure: f64,
    /// Whether the drive flank carries.
    pub driving: bool,
}

impl MeshLoad {
    /// Adds the load of a pair.
    pub fn add(&mut self, strength: &GearStrength, load: &ToothLoad) {
        // referred to the mean cone distance, as in the formulas of strength
        self.normal += load.normal * load.cone / strength.mean_cone;
        self.driving = load.flank == Flank::Drive;
        let pressure = strength.rating.contact.pressure_at(load.line_load, load.cone, load.s);
        self.pressure = self.pressure.max(pressure.unwrap_or(0.0));
    }
}

//! Everything a user can fix before the first step.

use serde::{Deserialize, Serialize};

use super::scene_effects::SceneEffects;
use crate::contact::ContactSpec;
use crate::geometry::{GearSpec, Pair};
use crate::model::effect_kinds::effect::Setting;
use crate::model::effects::{EffectParameters, Effects};
use crate::model::scene::{
    CarrierDrive, GearContact, InertiaSpec, Material, Method, PlanetSpin, Scene, SideDrive, SolidTeeth, SolverSpec,
    Start,
};

/// All parameters; the default is the study's straight case.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Gear pair and number of planets.
    pub geometry: GearSpec,
    /// Material of the gears.
    pub material: Material,
    /// Moments of inertia.
    pub inertia: InertiaSpec,
    /// Contact law.
    pub contact: ContactSpec,
    /// Drives and representation.
    pub scene: Scene,
    /// Switches of the effects.
    pub effects: Effects,
    /// Facets of solid teeth.
    pub solid: SolidTeeth,
    /// Parameters of the effects.
    pub specs: EffectParameters,
    /// Integration.
    pub solver: SolverSpec,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            geometry: GearSpec::default(),
            material: Material { young_modulus: 2.07e11, poisson_ratio: 0.25, density: 7800.0 },
            inertia: InertiaSpec {
                from_geometry: true,
                carrier: 0.02,
                side_gear: 1.47e-4,
                planet: 3.23e-5,
                left_end: 0.0,
                right_end: 0.0,
            },
            contact: ContactSpec::default(),
            scene: Scene {
                carrier_drive: CarrierDrive::Speed,
                left_drive: SideDrive::Torque,
                right_drive: SideDrive::Torque,
                planet_spin: PlanetSpin::Free,
                gear_contact: GearContact::Tooth,
                start: Start::Equilibrium,
            },
            effects: Effects::TEETH,
            solid: SolidTeeth { facets: 32, smoothing: 1.0 },
            specs: EffectParameters::default(),
            solver: SolverSpec {
                method: Method::Adaptive,
                relative_tolerance: 1e-6,
                fixed_step: 1e-4,
                merge_planets: true,
            },
        }
    }
}

impl Parameters {
    /// The gears as they mesh: without play where backlash is off.
    pub fn gears(&self) -> GearSpec {
        GearSpec { backlash: if self.effects.backlash { self.geometry.backlash } else { 0.0 }, ..self.geometry }
    }

    /// The effects of the scene with the gears `pair`.
    pub fn scene_effects<'a>(&'a self, pair: &'a Pair) -> SceneEffects<'a> {
        let setting = Setting {
            scene: &self.scene,
            geometry: &self.geometry,
            pair,
            material: &self.material,
            inertia: &self.inertia,
            contact: &self.contact,
            teeth: None,
            on: false,
            heat: 0,
        };
        SceneEffects { effects: &self.effects, parameters: &self.specs, setting }
    }
}

//! Parameters that a user sets before the first step.

use super::SceneEffects;
use crate::contact::ContactSpec;
use crate::geometry::{GearSpec, Pair};
use crate::model::effect_kinds::Setting;
use crate::model::effects::{EffectParameters, Effects};
use crate::model::scene::{InertiaSpec, Material, OilSpec, Scene, SolidTeeth, SolverSpec};

spec! {
    /// All parameters; the default is the study's straight case.
    pub struct Parameters {
        /// Gear pair and number of planets.
        pub geometry: GearSpec = GearSpec::default(),
        /// Material of the gears.
        pub material: Material = Material::default(),
        /// Oil.
        pub oil: OilSpec = OilSpec::default(),
        /// Moments of inertia.
        pub inertia: InertiaSpec = InertiaSpec::default(),
        /// Contact law.
        pub contact: ContactSpec = ContactSpec::default(),
        /// Drives and representation.
        pub scene: Scene = Scene::default(),
        /// Switches of the effects.
        pub effects: Effects = Effects::TEETH,
        /// Facets of solid teeth.
        pub solid: SolidTeeth = SolidTeeth::default(),
        /// Parameters of the effects.
        pub specs: EffectParameters = EffectParameters::default(),
        /// Integration.
        pub solver: SolverSpec = SolverSpec::default(),
    }
}

impl Parameters {
    /// Gears as they mesh: without play if backlash is off.
    pub fn gears(&self) -> GearSpec {
        GearSpec { backlash: if self.effects.backlash { self.geometry.backlash } else { 0.0 }, ..self.geometry }
    }

    /// Effects of the scene with the gears `pair`.
    pub fn scene_effects<'a>(&'a self, pair: &'a Pair) -> SceneEffects<'a> {
        let setting = Setting {
            scene: &self.scene,
            geometry: &self.geometry,
            pair,
            material: &self.material,
            oil: &self.oil,
            inertia: &self.inertia,
            contact: &self.contact,
            teeth: None,
            on: false,
            heat_index: 0,
        };
        SceneEffects { effects: &self.effects, parameters: &self.specs, setting }
    }
}

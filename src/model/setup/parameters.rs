//! Parameters that a user sets before the first step.

use std::any::{Any, TypeId};

use serde::{Deserialize, Serialize};

use super::SceneEffects;
use crate::contact::ContactSpec;
use crate::declaration::{Groups, Rows, RowsOf};
use crate::geometry::{GearSpec, Pair};
use crate::model::effect_kinds::Setting;
use crate::model::effects::{EffectParameters, Effects};
use crate::model::scene::{InertiaSpec, Material, OilSpec, Scene, SolidTeeth, SolverSpec};

macro_rules! groups {
    ($($(#[$doc:meta])+ $name:ident: $type:ty = $start:expr;)+) => {
        /// All parameters; the default is the study's straight case.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        pub struct Parameters {
            $($(#[$doc])+ pub $name: $type,)+
        }

        impl Default for Parameters {
            fn default() -> Self {
                Self { $($name: $start,)+ }
            }
        }

        impl Rows for Parameters {
            fn rows() -> RowsOf<Self> {
                let mut rows = Vec::new();
                $(rows.extend(<$type>::rows().into_iter().map(|row| row.map(|at| at.within(|p: &mut Self| &mut p.$name))));)+
                rows
            }

            fn find(&self, kind: TypeId) -> Option<&dyn Any> {
                None $(.or_else(|| self.$name.find(kind)))+
            }
        }
    };
}

groups! {
    /// Gear pair and number of planets.
    geometry: GearSpec = GearSpec::default();
    /// Material of the gears.
    material: Material = Material::default();
    /// Oil.
    oil: OilSpec = OilSpec::default();
    /// Moments of inertia.
    inertia: InertiaSpec = InertiaSpec::default();
    /// Contact law.
    contact: ContactSpec = ContactSpec::default();
    /// Drives and representation.
    scene: Scene = Scene::default();
    /// Switches of the effects.
    effects: Effects = Effects::TEETH;
    /// Integration.
    solver: SolverSpec = SolverSpec::default();
    /// Facets of solid teeth.
    solid: SolidTeeth = SolidTeeth::default();
    /// Parameters of the effects.
    specs: EffectParameters = EffectParameters::default();
}

impl Groups for Parameters {
    fn group(&self, kind: TypeId) -> Option<&dyn Any> {
        self.find(kind)
    }

    fn is_on(&self, kind: TypeId) -> Option<bool> {
        self.effects.is_on(kind)
    }
}

impl Parameters {
    /// Gears as they mesh: without play if backlash is off.
    pub fn gears(&self) -> GearSpec {
        GearSpec { backlash: if self.effects.teeth.backlash { self.geometry.backlash } else { 0.0 }, ..self.geometry }
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
            body_index: 0,
        };
        SceneEffects { effects: &self.effects, parameters: &self.specs, setting }
    }
}

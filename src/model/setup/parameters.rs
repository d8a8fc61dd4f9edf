//! Parameters that a user sets before the first step.

use std::any::{Any, TypeId};

use serde::{Deserialize, Serialize};

use super::SceneEffects;
use crate::contact::ContactSpec;
use crate::declaration::{Groups, Rows, RowsOf};
use crate::geometry::{GearSpec, Pair};
use crate::model::effect_kinds::EffectSetting;
use crate::model::effects::{EffectParameters, Effects};
use crate::model::scene::{InertiaSpec, Material, OilSpec, Scene, SolidTeeth, SolverSpec};

macro_rules! groups {
    ($($(#[$doc:meta])+ $name:ident: $type:ty;)+) => {
        /// All parameters; the default is the study's straight case.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Parameters {
            $($(#[$doc])+ pub $name: $type,)+
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
    geometry: GearSpec;
    /// Material of the gears.
    material: Material;
    /// Oil.
    oil: OilSpec;
    /// Moments of inertia.
    inertia: InertiaSpec;
    /// Contact law.
    contact: ContactSpec;
    /// Drives and representation.
    scene: Scene;
    /// Switches of the effects.
    effects: Effects;
    /// Integration.
    solver: SolverSpec;
    /// Facets of solid teeth.
    solid: SolidTeeth;
    /// Parameters of the effects.
    specs: EffectParameters;
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
        let setting = EffectSetting {
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

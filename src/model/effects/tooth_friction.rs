//! Friction along the flanks (`friction`), evaluated slice by slice in the meshes.

use crate::contact::tooth_friction;
use crate::declaration::{Condition, Need, all};
use crate::friction::{FrictionLaw, ToothFrictionSpec};
use crate::model::effect_kinds::{Declare, Effect, EffectSetting, FlankFriction, Heat, Needs, Warmed};
use crate::model::scene::GearContact;
use crate::model::thermal::GEARS;
use crate::problem::Problem;

impl Declare for ToothFrictionSpec {
    const DESCRIPTION: &'static str = "Friction along the flanks: Coulomb-Stribeck or one of three published laws";
    const BIASES_TORQUE: bool = true;
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.tooth_friction",
        description: "Heat of friction along the flanks since the start",
        warms: Warmed::Node(GEARS),
    });
    const NEEDS: Option<Needs> = Some(Needs { contacts: &[GearContact::Tooth], why: "it acts on single tooth pairs" });

    fn needs() -> Vec<(Need, Condition)> {
        let oiled = [on!(Self), is!(Self.viscosity_from_oil, true), differs!(Self.law, FrictionLaw::CoulombStribeck)];
        vec![(Need::DynamicViscosity, all(oiled))]
    }
}

impl Effect for ToothFrictionSpec {
    fn check(&self, _: &EffectSetting, found: &mut Vec<Problem>) {
        found.extend(self.problem());
    }

    fn is_oiled(&self) -> bool {
        self.viscosity_from_oil && self.law != FrictionLaw::CoulombStribeck
    }

    fn on_flanks(&self, setting: &EffectSetting) -> Option<FlankFriction> {
        let material = setting.material;
        let modulus = material.young_modulus / (2.0 * (1.0 - material.poisson_ratio * material.poisson_ratio));
        Some(FlankFriction {
            law: tooth_friction::ToothFriction { spec: *self, modulus },
            heat_index: setting.heat_index,
        })
    }
}

//! Friction along the flanks (`friction`), evaluated slice by slice in the meshes.

use crate::contact::tooth_friction;
use crate::declaration::units::{self, MILLI_PA_S, UM};
use crate::declaration::{Parameter, Row, row};
use crate::friction::{FrictionLaw, ToothFrictionSpec};
use crate::model::effect_kinds::{Declare, Effect, FlankFriction, Heat, Needs, Setting};
use crate::model::scene::GearContact;
use crate::problem::Problem;

impl Declare for ToothFrictionSpec {
    const DESCRIPTION: &'static str = "Friction along the flanks: Coulomb-Stribeck or one of three published laws";
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.tooth_friction",
        description: "Heat of friction along the flanks since the start",
        at_wheels: false,
    });
    const NEEDS: Option<Needs> = Some(Needs { contacts: &[GearContact::Tooth], why: "it acts on single tooth pairs" });

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        vec![
            row("tooth_friction.law", "Friction law of the flanks").choice(|p| &mut p.law),
            row("tooth_friction.coefficient", "Kinetic coefficient of friction of the flanks")
                .tunable()
                .when("tooth_friction.law = coulomb_stribeck")
                .real(units::ONE, (0.0, 0.3), |p| &mut p.coefficient),
            row("tooth_friction.static_ratio", "Ratio of static to kinetic coefficient; 1 = no Stribeck peak")
                .when("tooth_friction.law = coulomb_stribeck")
                .real(units::ONE, (1.0, 10.0), |p| &mut p.static_ratio),
            row("tooth_friction.stribeck_speed", "Sliding speed at which the Stribeck peak has fallen to 1/e")
                .when("tooth_friction.law = coulomb_stribeck and tooth_friction.static_ratio > 1")
                .real(units::M_PER_S, (1e-6, 100.0), |p| &mut p.stribeck_speed),
            row("tooth_friction.regularisation_speed", "Sliding speed over which friction changes sign").real(
                units::M_PER_S,
                (1e-6, 1.0),
                |p| &mut p.regularisation_speed,
            ),
            row("tooth_friction.oil_viscosity", "Dynamic viscosity of the oil at the mesh inlet")
                .when("tooth_friction.law != coulomb_stribeck and tooth_friction.viscosity_from_oil = false")
                .real((units::PA_S, MILLI_PA_S), (1e-5, 100.0), |p| &mut p.oil_viscosity),
            row(
                "tooth_friction.viscosity_from_oil",
                "Viscosity of the oil at its temperature; false: \
                                                      tooth_friction.oil_viscosity",
            )
            .when("tooth_friction.law != coulomb_stribeck")
            .switch(|p| &mut p.viscosity_from_oil),
            row("tooth_friction.lubricant_factor", "Lubricant factor X_L of ISO/TR 14179-2")
                .when("tooth_friction.law = iso_14179")
                .real(units::ONE, (0.1, 3.0), |p| &mut p.lubricant_factor),
            row("tooth_friction.roughness", "Roughness R_a of the flanks")
                .when("tooth_friction.law != coulomb_stribeck")
                .real((units::METRE, UM), (0.0, 1e-4), |p| &mut p.roughness),
        ]
    }
}

impl Effect for ToothFrictionSpec {
    fn check(&self, _: &Setting, found: &mut Vec<Problem>) {
        found.extend(self.problem());
    }

    fn is_oiled(&self) -> bool {
        self.viscosity_from_oil && self.law != FrictionLaw::CoulombStribeck
    }

    fn on_flanks(&self, setting: &Setting) -> Option<FlankFriction> {
        let material = setting.material;
        let modulus = material.young_modulus / (2.0 * (1.0 - material.poisson_ratio * material.poisson_ratio));
        Some(FlankFriction {
            law: tooth_friction::ToothFriction { spec: *self, modulus },
            heat_index: setting.heat_index,
        })
    }
}

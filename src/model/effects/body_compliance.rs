//! Elastic bodies of the gears under their teeth (`contact::bodies`, `contact::shared`): side gears on their splines, planets on
//! their pins, by the bores `geometry.side_bore` and `geometry.planet_bore`.

use serde::{Deserialize, Serialize};

use crate::contact::ContactLaw;
use crate::declaration::{Parameter, Row};
use crate::model::effect_kinds::effect::{Declare, Effect, Needs, Setting};
use crate::model::effect_kinds::teeth::ToothEffects;
use crate::model::scene::GearContact;
use crate::problem::Problem;

/// It has no parameters of its own: geometry and material say all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyComplianceSpec {}

impl Declare for BodyComplianceSpec {
    const DESCRIPTION: &'static str = "Elastic bodies of the gears on their bores: they turn and tilt under load, and neighbouring teeth move each other";
    const NEEDS: Option<Needs> =
        Some(Needs { contacts: &[GearContact::Tooth], why: "it adds to the deflection of single tooth pairs" });
    const EXAMPLE: &'static [(&'static str, f64)] =
        &[("contact.law", 2.0), ("geometry.planet_bore", 16e-3), ("geometry.side_bore", 30e-3)];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        Vec::new()
    }
}

impl Effect for BodyComplianceSpec {
    fn check(&self, setting: &Setting, found: &mut Vec<Problem>) {
        if setting.contact.law == ContactLaw::Impact {
            found.push(Problem::new(
                "effects.body_compliance",
                "does not work with contact.law = impact, whose stiffness is not that of the teeth; it needs \
                 contact.law = line or line_weber",
            ));
        }
    }

    fn on_teeth(&self, _: &Setting, teeth: &mut ToothEffects) -> Result<(), Problem> {
        teeth.on_bodies = true;
        Ok(())
    }
}

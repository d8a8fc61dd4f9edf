//! Elastic gear bodies under the teeth (`contact::bodies`, `contact::shared`). Side gears are held by splines in the
//! bore `geometry.side_bore`, and planets by pins in the bore `geometry.planet_bore`.

use crate::contact::bodies::Support;
use crate::model::effect_kinds::{Declare, Effect, EffectSetting, Needs, ToothEffects};
use crate::model::scene::GearContact;
use crate::numeric::sin;
use crate::problem::Problem;

parameters! {
    /// Elastic gear bodies. Geometry and material determine them, so the effect has no parameters.
    pub struct BodyComplianceSpec in "body_compliance" {}
}

impl Declare for BodyComplianceSpec {
    const DESCRIPTION: &'static str = "Elastic gear bodies: they turn and tilt on their bores, and a loaded tooth \
                                       deflects its neighbours";
    const NEEDS: Option<Needs> =
        Some(Needs { contacts: &[GearContact::Tooth], why: "it adds to the deflection of single tooth pairs" });
    const EXAMPLE: &'static [(&'static str, f64)] =
        &[("contact.law", 2.0), ("geometry.planet_bore", 16e-3), ("geometry.side_bore", 30e-3)];
}

/// Ratio of bore to root circle at the toe below which a bore that transmits torque dominates the compliance of the
/// gear.
const NARROW: f64 = 0.5;

/// Names of the bores, of the gears, and of the parts that hold them.
const BORES: [[&str; 3]; 2] = [["geometry.planet_bore", "planet", "pin"], ["geometry.side_bore", "side gear", "shaft"]];

/// Warning about the assumed support of gear `i` if it has no bore, or if the bore of a side gear is so narrow that it
/// dominates the compliance. `None` for other bores. A narrow planet bore causes no warning, because pins transmit no
/// torque.
fn assumed(setting: &EffectSetting, i: usize) -> Option<Problem> {
    let [name, gear, holder] = BORES[i];
    let bore = [setting.geometry.planet_bore, setting.geometry.side_bore][i];
    let toe = 2.0 * setting.pair.inner_cone * sin(setting.pair.gears[i].root);
    let text = if bore == 0.0 {
        format!(
            "{name} = 0 mm: the {gear} is taken as one piece with a {holder} as thick as the gear below its teeth, held two \
             modules below the roots; that is about as stiff as on the widest bore, {:.3} mm; give the diameter of \
             the {holder} if it has one",
            Support::widest(setting.pair, i) * 1e3
        )
    } else if i == 1 && bore < NARROW * toe {
        format!(
            "{name} = {:.3} mm is less than half the root circle at the toe, {:.3} mm: all torque of the {gear} passes \
             through a {holder} of this diameter, and its elastic rotation grows with 1/diameter^2; if the gear and \
             its {holder} are one piece, or the bore is only a hole, set 0",
            bore * 1e3,
            toe * 1e3
        )
    } else {
        return None;
    };
    // the warning concerns an assumption of the effect, so it does not name the bore as its variable
    Some(Problem::new("effects.body_compliance", text))
}

impl Effect for BodyComplianceSpec {
    fn warnings(&self, setting: &EffectSetting) -> Vec<Problem> {
        (0..2).filter_map(|i| assumed(setting, i)).collect()
    }

    fn check(&self, setting: &EffectSetting, found: &mut Vec<Problem>) {
        let law = setting.contact.law;
        if !law.is_of_teeth() {
            found.push(problem!(
                "effects.body_compliance",
                "does not work with contact.law = {}, whose stiffness is not that of the teeth; it needs \
                 contact.law = line or line_weber",
                law.literal()
            ));
        }
    }

    fn on_teeth(&self, _: &EffectSetting, teeth: &mut ToothEffects) -> Result<(), Problem> {
        teeth.elastic_bodies = true;
        Ok(())
    }
}

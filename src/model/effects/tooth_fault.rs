//! Tooth that loses a piece during a run, at a given time or by `fault.trigger` (`contact::errors::Chip`).

use std::sync::Arc;

use crate::contact::FlankGaps;
use crate::contact::errors::{Chip, ToothFaultSpec, breaks};
use crate::declaration::units::ONE;
use crate::declaration::{Row, row};
use crate::model::effect_kinds::{Class, Declare, Effect, EffectSetting, InputField, Needs, ToothEffects};
use crate::model::scene::GearContact;
use crate::problem::Problem;

impl Declare for ToothFaultSpec {
    const DESCRIPTION: &'static str = "Broken tooth: a piece breaks off at a given time or by fault.trigger";
    const CLASS: Class = Class::Machine;
    const NEEDS: Option<Needs> = Some(Needs { contacts: &[GearContact::Tooth], why: "it acts on single tooth pairs" });
    const EXAMPLE: &'static [(&'static str, f64)] =
        &[("tooth_fault.at_onset", 1.0), ("tooth_fault.onset", 1e-9), ("tooth_fault.missing_fraction", 0.6)];

    fn inputs() -> Vec<Row<InputField>> {
        vec![
            row("fault.trigger", "Breaks the tooth of effects.tooth_fault when it rises above 0.5")
                .when(breaks())
                .command(ONE, 1.0, |i| &mut i.fault),
        ]
    }
}

impl Effect for ToothFaultSpec {
    fn check(&self, setting: &EffectSetting, found: &mut Vec<Problem>) {
        let planets = usize::try_from(setting.geometry.planet_count).unwrap_or(0);
        found.extend(self.check(setting.pair.gears.map(|g| g.teeth), planets).err());
        let law = setting.contact.law;
        if !law.is_of_teeth() && self.missing_fraction <= 0.5 {
            found.push(problem!(
                "tooth_fault.missing_fraction",
                "{}: contact.law = {} acts only at the middle of the face, which a piece of at most 0.5 of the face \
                 does not reach; choose line or line_weber, or a larger piece",
                self.missing_fraction,
                law.literal()
            ));
        }
    }

    fn on_teeth(&self, setting: &EffectSetting, teeth: &mut ToothEffects) -> Result<(), Problem> {
        let (pair, count) = (setting.pair, setting.geometry.planet_count);
        let sound = teeth.gaps[0].clone();
        let mut broken = match &sound {
            Some(gaps) => (**gaps).clone(),
            None => FlankGaps::perfect(pair, count),
        };
        broken.chip = Chip::new(self, pair, usize::try_from(count).unwrap_or(1))?;
        teeth.gaps = [sound, Some(Arc::new(broken))];
        (teeth.individual, teeth.distributed) = (true, true);
        Ok(())
    }
}

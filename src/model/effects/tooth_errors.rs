//! Deviations, modifications and misalignment of the teeth: gaps e_k(s, R) of each pair (`contact::errors`).

use std::sync::Arc;

use crate::contact::FlankGaps;
use crate::contact::errors::{ToothErrorSpec, ToothErrors, pitch};
use crate::model::effect_kinds::{Declare, Effect, EffectSetting, Needs, ToothEffects};
use crate::model::scene::GearContact;
use crate::problem::Problem;

impl Declare for ToothErrorSpec {
    const DESCRIPTION: &'static str =
        "Tooth errors: pitch deviations by accuracy grade, runout, tip relief, crowning, misalignment";
    const NEEDS: Option<Needs> =
        Some(Needs { contacts: &[GearContact::Tooth, GearContact::Solid], why: "it acts on single tooth pairs" });
    const EXAMPLE: &'static [(&'static str, f64)] =
        &[("tooth_errors.accuracy_grade", 7.0), ("tooth_errors.seed", 1.0), ("tooth_errors.planet_tip_relief", 20e-6)];
}

impl Effect for ToothErrorSpec {
    fn check(&self, setting: &EffectSetting, found: &mut Vec<Problem>) {
        found.extend(self.check().err());
        if setting.scene.gear_contact != GearContact::Solid {
            return;
        }
        let unsupported = [
            ("tooth_errors.accuracy_grade", self.accuracy_grade != 0),
            ("tooth_errors.planet_runout", self.planet_runout != 0.0),
            ("tooth_errors.side_runout", self.side_runout != 0.0),
            ("tooth_errors.planet_tip_relief", self.planet_tip_relief != 0.0),
            ("tooth_errors.side_tip_relief", self.side_tip_relief != 0.0),
        ];
        let what =
            "solid teeth support only crowning and misalignment: it must be 0, or choose scene.gear_contact = tooth";
        found.extend(unsupported.into_iter().filter(|&(_, given)| given).map(|(name, _)| Problem::new(name, what)));
    }

    fn warnings(&self, setting: &EffectSetting) -> Vec<Problem> {
        if self.accuracy_grade == 0 || (0..2).all(|i| pitch::Tolerances::covers(setting.pair, i)) {
            return Vec::new();
        }
        vec![Problem::new(
            "tooth_errors.accuracy_grade",
            "the gears are outside the ranges for which ISO 17485 gives its tolerances \
             (mean module 1 to 50 mm, tolerance diameter 5 to 2500 mm, 5 to 400 teeth)",
        )]
    }

    fn on_teeth(&self, setting: &EffectSetting, teeth: &mut ToothEffects) -> Result<(), Problem> {
        let (pair, count) = (setting.pair, setting.geometry.planet_count);
        let mut errors = ToothErrors::new(self, pair, usize::try_from(count).unwrap_or(1))?;
        if let Some(given) = setting.teeth {
            errors = errors.with_teeth(given)?;
        }
        teeth.individual |= errors.is_individual();
        teeth.distributed |= !errors.is_uniform_over_face();
        let mut gaps = FlankGaps::perfect(pair, count);
        gaps.least = -errors.max_excess(pair.outer_cone);
        gaps.errors = Some(errors);
        let gaps = Arc::new(gaps);
        teeth.gaps = [Some(gaps.clone()), Some(gaps)];
        Ok(())
    }
}

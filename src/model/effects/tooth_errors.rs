//! Deviations, modifications and misalignment of the teeth: gaps e_k(s, R) of each pair (`contact::errors`).

use std::sync::Arc;

use crate::contact::FlankGaps;
use crate::contact::errors::{ToothErrorSpec, ToothErrors, pitch};
use crate::declaration::units::{self, DEG, UM};
use crate::declaration::{Parameter, Row, row};
use crate::model::effect_kinds::{Declare, Effect, Needs, Setting, ToothEffects};
use crate::model::scene::GearContact;
use crate::problem::Problem;

impl Declare for ToothErrorSpec {
    const DESCRIPTION: &'static str =
        "Tooth errors: pitch deviations by accuracy grade, runout, tip relief, crowning, misalignment";
    const NEEDS: Option<Needs> =
        Some(Needs { contacts: &[GearContact::Tooth, GearContact::Solid], why: "it acts on single tooth pairs" });
    const EXAMPLE: &'static [(&'static str, f64)] =
        &[("tooth_errors.accuracy_grade", 7.0), ("tooth_errors.seed", 1.0), ("tooth_errors.planet_tip_relief", 20e-6)];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        vec![
            row("tooth_errors.accuracy_grade", "Pitch accuracy grade by ISO 17485, 2 to 11; 0 = no pitch deviations")
                .integer((0, 11), |p| &mut p.accuracy_grade),
            row("tooth_errors.seed", "Seed of the individual pitch deviations and runout phases")
                .when(
                    "tooth_errors.accuracy_grade > 0 or tooth_errors.planet_runout > 0 or tooth_errors.side_runout > 0",
                )
                .integer((-2147483648, 2147483647), |p| &mut p.seed),
            row("tooth_errors.planet_runout", "Radial runout of each planet, peak to peak")
                .when("tooth_errors.runout_by_grade = false")
                .real((units::METRE, UM), (0.0, 1e-3), |p| &mut p.planet_runout),
            row("tooth_errors.side_runout", "Radial runout of each side gear, peak to peak")
                .when("tooth_errors.runout_by_grade = false")
                .real((units::METRE, UM), (0.0, 1e-3), |p| &mut p.side_runout),
            row(
                "tooth_errors.runout_by_grade",
                "Runout of all gears from the tolerance of the accuracy grade; \
                                                 false: given values",
            )
            .switch(|p| &mut p.runout_by_grade),
            row("tooth_errors.planet_tip_relief", "Tip relief of the planets along the line of action").real(
                (units::METRE, UM),
                (0.0, 1e-3),
                |p| &mut p.planet_tip_relief,
            ),
            row("tooth_errors.side_tip_relief", "Tip relief of the side gears along the line of action").real(
                (units::METRE, UM),
                (0.0, 1e-3),
                |p| &mut p.side_tip_relief,
            ),
            row("tooth_errors.relief_length", "Length of the tip reliefs of both gears, in base pitches")
                .when("tooth_errors.planet_tip_relief > 0 or tooth_errors.side_tip_relief > 0")
                .real(units::ONE, (0.01, 2.0), |p| &mut p.relief_length),
            row(
                "tooth_errors.crowning",
                "Lengthwise crowning of a tooth pair: gap at both ends of the face relative to its middle",
            )
            .real((units::METRE, UM), (0.0, 1e-3), |p| &mut p.crowning),
            row(
                "tooth_errors.shaft_angle_error",
                "Tilt of each planet axis away from the left side gear, toward the right one",
            )
            .real((units::RADIAN, DEG), (-0.02, 0.02), |p| &mut p.shaft_angle_error),
            row("tooth_errors.planet_axial_offset", "Displacement of each planet along its axis, outward").real(
                (units::METRE, UM),
                (-1e-3, 1e-3),
                |p| &mut p.planet_axial_offset,
            ),
            row(
                "tooth_errors.side_axial_offset",
                "Displacement of each side gear along its axis, away from the planet axes",
            )
            .real((units::METRE, UM), (-1e-3, 1e-3), |p| &mut p.side_axial_offset),
            row(
                "tooth_errors.axis_offset",
                "Displacement of all pins together, across the side gear axis, with planet 1 forward",
            )
            .real((units::METRE, UM), (-1e-3, 1e-3), |p| &mut p.axis_offset),
        ]
    }
}

impl Effect for ToothErrorSpec {
    fn check(&self, setting: &Setting, found: &mut Vec<Problem>) {
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

    fn warnings(&self, setting: &Setting) -> Vec<Problem> {
        if self.accuracy_grade == 0 || (0..2).all(|i| pitch::Tolerances::covers(setting.pair, i)) {
            return Vec::new();
        }
        vec![Problem::new(
            "tooth_errors.accuracy_grade",
            "the gears are outside the ranges for which ISO 17485 gives its tolerances \
             (mean module 1 to 50 mm, tolerance diameter 5 to 2500 mm, 5 to 400 teeth)",
        )]
    }

    fn on_teeth(&self, setting: &Setting, teeth: &mut ToothEffects) -> Result<(), Problem> {
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

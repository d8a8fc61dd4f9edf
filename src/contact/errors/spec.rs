//! User parameters of tooth errors: deviations, modifications, misalignment, and a broken tooth.

use crate::contact::{ContactLaw, ContactSpec};
use crate::declaration::prelude::*;
use crate::problem::Problem;

/// Largest deviation or modification of a flank [m]. First-order formulas are not valid beyond it.
const MAX_DEVIATION: f64 = 1e-3;
/// Largest error of the shaft angle [rad]. First-order formulas are not valid beyond it.
const MAX_ANGLE: f64 = 0.02;

parameters! {
    /// Deviations and modifications of all teeth; the default is error-free teeth.
    pub struct ToothErrorSpec in "tooth_errors" {
        /// Pitch accuracy grade by ISO 17485, 2 to 11; 0 = no pitch deviations
        accuracy_grade: i32 = 0, 0..=11;
        /// Seed of the individual pitch deviations and runout phases
        seed: i32 = 0, i32::MIN..=i32::MAX,
            when(any([above!(Self.accuracy_grade, 0), above!(Self.planet_runout, 0.0), above!(Self.side_runout, 0.0)]));
        /// Radial runout of each planet, peak to peak
        planet_runout: f64 = 0.0, METRE | UM, 0.0..=1e-3, when(is!(Self.runout_by_grade, false));
        /// Radial runout of each side gear, peak to peak
        side_runout: f64 = 0.0, METRE | UM, 0.0..=1e-3, when(is!(Self.runout_by_grade, false));
        /// Runout of all gears from the tolerance of the accuracy grade; false: given values
        runout_by_grade: bool = false;
        /// Tip relief of the planets along the line of action
        planet_tip_relief: f64 = 0.0, METRE | UM, 0.0..=1e-3;
        /// Tip relief of the side gears along the line of action
        side_tip_relief: f64 = 0.0, METRE | UM, 0.0..=1e-3;
        /// Length of the tip reliefs of both gears, in base pitches
        relief_length: f64 = 0.3, ONE, 0.01..=2.0,
            when(any([above!(Self.planet_tip_relief, 0.0), above!(Self.side_tip_relief, 0.0)]));
        /// Lengthwise crowning of a tooth pair: gap at both ends of the face relative to its middle
        crowning: f64 = 0.0, METRE | UM, 0.0..=1e-3;
        /// Tilt of each planet axis away from the left side gear, toward the right one
        shaft_angle_error: f64 = 0.0, RADIAN | DEG, -0.02..=0.02;
        /// Displacement of each planet along its axis, outward
        planet_axial_offset: f64 = 0.0, METRE | UM, -1e-3..=1e-3;
        /// Displacement of each side gear along its axis, away from the planet axes
        side_axial_offset: f64 = 0.0, METRE | UM, -1e-3..=1e-3;
        /// Displacement of all pins together, across the side gear axis, with planet 1 forward
        axis_offset: f64 = 0.0, METRE | UM, -1e-3..=1e-3;
    }
}

choices! {
    /// Gear that has the broken tooth.
    pub enum FaultyGear: "FaultyGear" {
        None = 1, "none": "no broken tooth";
        Planet = 2, "planet": "a tooth of a planet";
        Side = 3, "side": "a tooth of a side gear";
    }
}

parameters! {
    /// A tooth that loses a piece at its heel while running.
    pub struct ToothFaultSpec in "tooth_fault" {
        /// Kind of gear with the broken tooth
        gear: FaultyGear = FaultyGear::Planet;
        /// Planet (0 = planet[1]) or side gear (0 = left, 1 = right) with the broken tooth
        index: i32 = 0, 0..=3, when(breaks());
        /// Number of the broken tooth, counted from 0
        tooth: i32 = 0, 0..=199, when(breaks());
        /// Missing fraction of the face width, from the heel inward
        missing_fraction: f64 = 0.6, ONE, 0.0..=1.0,
            when(all([breaks(), is!(ContactSpec.law, ContactLaw::Line, ContactLaw::LineWeber)]));
        /// Depth removed along the line of action
        depth: f64 = 1e-3, METRE | MM, 0.0..=1e-2, when(breaks());
        /// The piece breaks off at tooth_fault.onset; false: only by fault.trigger
        at_onset: bool = false, when(breaks());
        /// Time at which the piece breaks off; a run that starts later starts with the broken tooth
        onset: f64 = 0.0, SECOND, when(all([breaks(), is!(Self.at_onset, true)]));
    }
}

/// Condition that a tooth can break.
pub fn breaks() -> Condition {
    differs!(ToothFaultSpec.gear, FaultyGear::None)
}

impl ToothErrorSpec {
    /// Fails with the first invalid value.
    pub fn check(&self) -> Result<(), Problem> {
        let grade = self.accuracy_grade;
        if grade != 0 && !(2..=11).contains(&grade) {
            return Err(problem!(
                "tooth_errors.accuracy_grade",
                "{grade} is not an accuracy grade of ISO 17485; allowed 2 (finest) to 11, or 0 for no deviations"
            ));
        }
        if self.runout_by_grade && grade == 0 {
            return Err(Problem::new(
                "tooth_errors.runout_by_grade",
                "runout follows from the accuracy grade, but tooth_errors.accuracy_grade is 0: set a grade from 2 to 11",
            ));
        }
        let metres = [
            ("tooth_errors.planet_runout", self.planet_runout, 0.0),
            ("tooth_errors.side_runout", self.side_runout, 0.0),
            ("tooth_errors.planet_tip_relief", self.planet_tip_relief, 0.0),
            ("tooth_errors.side_tip_relief", self.side_tip_relief, 0.0),
            ("tooth_errors.crowning", self.crowning, 0.0),
            ("tooth_errors.planet_axial_offset", self.planet_axial_offset, -MAX_DEVIATION),
            ("tooth_errors.side_axial_offset", self.side_axial_offset, -MAX_DEVIATION),
            ("tooth_errors.axis_offset", self.axis_offset, -MAX_DEVIATION),
        ];
        for (variable, value, least) in metres {
            within(variable, value, [least, MAX_DEVIATION], "m")?;
        }
        within("tooth_errors.shaft_angle_error", self.shaft_angle_error, [-MAX_ANGLE, MAX_ANGLE], "rad")?;
        within("tooth_errors.relief_length", self.relief_length, [0.01, 2.0], "base pitches")
    }
}

impl ToothFaultSpec {
    /// Fails with the first value that is invalid for gears of `teeth` (planet, side gear) and `planets` planets.
    pub fn check(&self, teeth: [i32; 2], planets: usize) -> Result<(), Problem> {
        let (gears, teeth) = match self.gear {
            FaultyGear::None => return Ok(()),
            FaultyGear::Planet => (planets, teeth[0]),
            FaultyGear::Side => (2, teeth[1]),
        };
        if usize::try_from(self.index).is_ok_and(|i| i < gears) {
            within("tooth_fault.tooth", f64::from(self.tooth), [0.0, f64::from(teeth - 1)], "(number of the tooth)")?;
        } else {
            return Err(problem!(
                "tooth_fault.index",
                "{} does not exist: gears of this kind are numbered from 0 to {}",
                self.index,
                gears.saturating_sub(1)
            ));
        }
        within("tooth_fault.missing_fraction", self.missing_fraction, [0.0, 1.0], "(fraction of the face width)")?;
        within("tooth_fault.depth", self.depth, [0.0, 0.1], "m")?;
        within("tooth_fault.onset", self.onset, [f64::MIN, f64::MAX], "s")
    }

    /// Time at which the piece breaks off without a trigger [s], or `None`.
    pub fn time(&self) -> Option<f64> {
        self.at_onset.then_some(self.onset)
    }
}

fn within(variable: &'static str, value: f64, [least, most]: [f64; 2], unit: &str) -> Result<(), Problem> {
    if (least..=most).contains(&value) {
        Ok(())
    } else {
        Err(problem!(variable, "{value} {unit} is outside the range from {least} to {most} {unit}"))
    }
}

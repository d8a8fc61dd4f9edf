//! User parameters of tooth errors: deviations, modifications, misalignment, and a broken tooth.

use crate::problem::Problem;

/// Largest deviation or modification of a flank [m]. First-order formulas are not valid beyond it.
const MAX_DEVIATION: f64 = 1e-3;
/// Largest error of the shaft angle [rad]. First-order formulas are not valid beyond it.
const MAX_ANGLE: f64 = 0.02;

spec! {
    /// Deviations and modifications of all teeth; the default is error-free teeth.
    pub struct ToothErrorSpec {
        /// Accuracy grade B of ISO 17485:2006 for the pitch of every gear: 2 to 11, 0 = no pitch deviations.
        pub accuracy_grade: i32 = 0,
        /// Seed of the individual pitch deviations and of the phases of runout.
        pub seed: i32 = 0,
        /// Radial runout F_r of each planet [m], peak to peak over a revolution: its teeth are eccentric to its axis by
        /// F_r/2.
        pub planet_runout: f64 = 0.0,
        /// Radial runout F_r of each side gear [m], peak to peak over a revolution: its teeth are eccentric to its axis
        /// by F_r/2.
        pub side_runout: f64 = 0.0,
        /// True if the runout of all gears is the tolerance F_rT of the accuracy grade instead of the two values above.
        pub runout_by_grade: bool = false,
        /// Tip relief of the planet: material missing at its tip, along the line of action [m].
        pub planet_tip_relief: f64 = 0.0,
        /// Tip relief of the side gear: material missing at its tip, along the line of action [m].
        pub side_tip_relief: f64 = 0.0,
        /// Length of both reliefs along the line of action, in base pitches.
        pub relief_length: f64 = 0.3,
        /// Lengthwise crowning of a tooth pair: gap at both face ends relative to the middle of the face [m].
        pub crowning: f64 = 0.0,
        /// Error of the shaft angle [rad]: each planet's axis leans away from the left side gear, toward the right one.
        pub shaft_angle_error: f64 = 0.0,
        /// Displacement of each planet along its own axis, outward [m].
        pub planet_axial_offset: f64 = 0.0,
        /// Displacement of each side gear along its own axis, away from the planets' axes [m].
        pub side_axial_offset: f64 = 0.0,
        /// Displacement of all planet pins, as one rigid body, from the side gears' axis [m], in the direction in which
        /// the forward-turning carrier moves planet 0. For planet 0 it is the hypoid offset, and for an opposite planet
        /// the negative hypoid offset. For planets between them, it is partly a hypoid offset and partly a displacement
        /// along their own axes.
        pub axis_offset: f64 = 0.0,
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

spec! {
    /// A tooth that loses a piece at its heel while running; the default is sound teeth.
    pub struct ToothFaultSpec {
        /// Kind of gear with the broken tooth.
        pub gear: FaultyGear = FaultyGear::None,
        /// Index of the planet (0 to N − 1) or side gear (0 left, 1 right).
        pub index: i32 = 0,
        /// Number of the tooth, from 0, counted as in [`super::PairId`].
        pub tooth: i32 = 0,
        /// Missing fraction of the face width, from the heel inward: 0 to 1.
        pub missing_fraction: f64 = 0.5,
        /// Depth removed along the line of action [m]. If it exceeds the approach of loaded teeth, nothing touches
        /// there.
        pub depth: f64 = 1e-3,
        /// True if the piece breaks off at `onset`. Otherwise only the trigger breaks it off.
        pub at_onset: bool = false,
        /// Time at which the piece breaks off [s].
        pub onset: f64 = 0.0,
    }
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

//! Individual teeth: the pitch and runout data that differ from tooth to tooth and gear to gear, random or measured.

use super::ToothErrors;
use crate::problem::Problem;

/// The teeth of one gear, counted as in [`super::PairId`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GearTeeth {
    /// Positions of the flanks along the line of action at R_m [m], tooth by tooth. The first list contains the flanks
    /// that face the direction in which teeth are counted, the second the others. Both are empty without pitch
    /// deviations.
    pub positions: [Vec<f64>; 2],
    /// Azimuth of the eccentricity from the centre of tooth 0, in the direction in which teeth are counted [rad].
    pub azimuth: f64,
}

impl ToothErrors {
    /// The teeth of all gears: side gears left and right, then planets.
    pub fn teeth(&self) -> Vec<GearTeeth> {
        (0..2 + self.planets)
            .map(|gear| GearTeeth {
                positions: self.pitch.as_ref().map(|pitch| pitch.of(gear)).unwrap_or_default(),
                azimuth: self.runout.as_ref().map_or(0.0, |runout| runout.azimuth(gear)),
            })
            .collect()
    }

    /// Replaces the teeth of all gears by `gears`, in the order of [`Self::teeth`]. Data of effects that are not
    /// modelled are ignored. Fails if the number of gears or teeth is wrong or a value is not finite.
    pub fn with_teeth(mut self, gears: &[GearTeeth]) -> Result<Self, Problem> {
        if gears.len() != 2 + self.planets {
            return Err(problem!(
                "tooth_errors.accuracy_grade",
                "the number of gears with given teeth is {}, but it must be {}",
                gears.len(),
                2 + self.planets
            ));
        }
        if let Some(runout) = &mut self.runout {
            runout.set_azimuths(gears)?;
        }
        if let Some(pitch) = &mut self.pitch {
            pitch.replace(gears)?;
        }
        Ok(self)
    }
}

//! Load cycles of a tooth: rolling of a gear relative to the carrier, and the flank that a mesh loads.
//!
//! Every mesh of a gear loads each of its teeth once per revolution relative to the carrier. A planet's tooth is loaded
//! once by the left and once by the right side gear, on opposite flanks, because a planet is an idler. A side gear's
//! tooth is loaded N times, on the same flank as long as the torque keeps its direction. In straight driving nothing
//! rolls, and nothing counts.

use serde::{Deserialize, Serialize};

use crate::numeric::{TAU, finite};

/// Rolling of a gear with a dead band of one tooth pitch. Rocking within a pitch brings no new tooth into mesh.
///
/// The angle of the gear pushes a window of one pitch along. Only the motion that pushes the window counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rolling {
    /// Position of the gear in its window [rad], −½ to ½ pitch.
    pub place: f64,
}

finite!(Rolling { place });

impl Rolling {
    /// Turns the gear relative to the carrier by `step` [rad] of either sign. Teeth are `pitch` [rad] apart. Returns
    /// the revolutions that count.
    pub fn advance(&mut self, step: f64, pitch: f64) -> f64 {
        let wanted = self.place + step;
        if !wanted.is_finite() || pitch.is_nan() || pitch < 0.0 {
            return 0.0;
        }
        self.place = wanted.max(-pitch / 2.0).min(pitch / 2.0);
        (wanted - self.place).abs() / TAU
    }

    /// Fraction of `step` [rad] that would count: 0 while the gear stays in its window, 1 if it pushes the window
    /// during the whole step.
    pub fn counting(&self, step: f64, pitch: f64) -> f64 {
        let beyond = (self.place + step).abs() - pitch / 2.0;
        if beyond > 0.0 { (beyond / step.abs()).min(1.0) } else { 0.0 }
    }
}

/// Flank (0 or 1) of a gear's teeth that a mesh loads.
///
/// A side gear has one mesh position, `far` = false. A planet has two, the left (`far` = false) and the right one
/// (`far` = true), which load opposite flanks if both drive. `driving` is true if the carrier drives the side gear.
pub fn loaded_flank(far: bool, driving: bool) -> usize {
    usize::from(far == driving)
}

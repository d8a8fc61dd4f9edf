//! Load cycles of a tooth: rolling of a gear relative to the carrier, and the flank that a mesh loads.
//!
//! Every mesh of a gear loads each of its teeth once per revolution relative to the carrier: a planet's tooth once by
//! the left and once by the right side gear, on opposite flanks (it is an idler); a side gear's tooth N times, on the
//! same flank as long as the torque keeps its direction. Straight ahead nothing rolls and nothing counts.

use serde::{Deserialize, Serialize};

use crate::numeric::{TAU, finite};

/// Rolling of a gear with a dead band of one tooth pitch: rocking within a pitch brings no new tooth into mesh.
///
/// The window of one pitch is pushed along by the gear's angle; only what pushes it counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rolling {
    /// Place of the gear in its window [rad], −½ to ½ pitch.
    pub place: f64,
}

finite!(Rolling { place });

impl Rolling {
    /// Turns the gear relative to the carrier by `step` [rad], of either sign, with teeth `pitch` [rad] apart; returns
    /// the revolutions that count.
    pub fn advance(&mut self, step: f64, pitch: f64) -> f64 {
        let wanted = self.place + step;
        if !wanted.is_finite() || pitch.is_nan() || pitch < 0.0 {
            return 0.0;
        }
        self.place = wanted.max(-pitch / 2.0).min(pitch / 2.0);
        (wanted - self.place).abs() / TAU
    }

    /// The part of `step` [rad] that would count: 0 while the gear stays in its window, 1 while it pushes it all the way.
    pub fn counting(&self, step: f64, pitch: f64) -> f64 {
        let beyond = (self.place + step).abs() - pitch / 2.0;
        if beyond > 0.0 { (beyond / step.abs()).min(1.0) } else { 0.0 }
    }
}

/// Flank (0 or 1) of a gear's teeth that a mesh loads.
///
/// A side gear has one mesh position, `far` = false; a planet has two, the left (`far` = false) and the right one
/// (`far` = true), which load opposite flanks as long as both drive. `driving`: the carrier drives the side gear.
pub fn loaded_flank(far: bool, driving: bool) -> usize {
    usize::from(far == driving)
}

//! Excitation by the final drive: the carrier's torque or imposed speed varies with the mesh order of the ring gear,
//! T = T₀ (1 + ε sin zθ) or ω = ω₀ (1 + ε cos zθ) — the first harmonic of a gear pair's mesh excitation.

use super::Setting;
use super::body::{Action, Bodies, BodyEffect, Slopes};
use crate::numeric::{cos, sin};

/// Excitation of the carrier.
#[derive(Clone, Copy, Debug)]
pub struct FinalDrive {
    teeth: f64,
    amplitude: f64,
    imposed: bool,
}

impl FinalDrive {
    /// Excitation of the scene.
    pub fn new(setting: &Setting) -> Self {
        let spec = &setting.parameters.specs.final_drive;
        Self { teeth: f64::from(spec.ring_teeth), amplitude: spec.amplitude, imposed: setting.plan.carrier_imposed }
    }
}

impl BodyEffect for FinalDrive {
    fn act(&self, at: &Bodies, out: &mut Action) {
        let c = at.layout.carrier();
        let wave = sin(self.teeth * at.q[c]);
        if self.imposed {
            *out.imposed += at.input_rates.carrier_speed * self.amplitude * cos(self.teeth * at.q[c]);
            *out.imposed -= at.inputs.carrier_speed * self.amplitude * self.teeth * wave * at.v[c];
        } else {
            *out.drive += at.inputs.carrier_torque * self.amplitude * wave;
        }
    }

    fn slopes(&self, at: &Bodies, out: &mut Slopes) {
        let c = at.layout.carrier();
        let (wave, slope) = (sin(self.teeth * at.q[c]), self.teeth * cos(self.teeth * at.q[c]));
        if self.imposed {
            let amplitude = at.inputs.carrier_speed * self.amplitude * self.teeth;
            out.imposed[0][c] -= amplitude * slope * at.v[c];
            out.imposed[0][c] -= at.input_rates.carrier_speed * self.amplitude * self.teeth * wave;
            out.imposed[1][c] -= amplitude * wave;
        } else {
            out.position(c, c, at.inputs.carrier_torque * self.amplitude * slope);
        }
    }

    fn carrier_speed(&self, q: &[f64], command: f64) -> f64 {
        if self.imposed {
            command * (1.0 + self.amplitude * cos(self.teeth * q[super::super::layout::CARRIER]))
        } else {
            command
        }
    }
}

//! Excitation by the final drive. The carrier's torque or imposed speed varies at the mesh order z of the ring gear,
//! T = T₀ (1 + ε sin zθ) or ω = ω₀ (1 + ε cos zθ): the first harmonic of a gear pair's mesh excitation.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{Action, BodyEffect, BodyMotion, Declare, Effect, Setting, Slopes};
use crate::model::scene::{CARRIER, Plan};
use crate::numeric::{cos, sin};

parameters! {
    /// Excitation by the final drive's ring gear.
    pub struct FinalDriveSpec in "final_drive" {
        /// Number of teeth of the ring gear
        ring_teeth: i32 = 37, 1..=1000, when(above!(Self.amplitude, 0.0));
        /// Amplitude of the excitation relative to the carrier command
        amplitude: f64 = 0.02, ONE, 0.0..=1.0;
    }
}

impl Declare for FinalDriveSpec {
    const DESCRIPTION: &'static str = "Excitation of the carrier at the mesh order of the final drive's ring gear";
}

impl Effect for FinalDriveSpec {
    fn on_bodies(&self, _: &Setting, plan: &Plan) -> Option<Box<dyn BodyEffect>> {
        let (teeth, amplitude) = (f64::from(self.ring_teeth), self.amplitude);
        Some(Box::new(Excitation { teeth, amplitude, imposed: plan.carrier_imposed }))
    }
}

/// Excitation of the carrier.
#[derive(Clone, Copy, Debug)]
struct Excitation {
    /// Teeth of the ring gear, z.
    teeth: f64,
    /// Amplitude ε relative to the carrier's command.
    amplitude: f64,
    /// True if the carrier's speed is imposed.
    imposed: bool,
}

impl BodyEffect for Excitation {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        let c = at.layout.carrier();
        let wave = sin(self.teeth * at.q[c]);
        if self.imposed {
            *out.imposed += at.input_rates.carrier_speed * self.amplitude * cos(self.teeth * at.q[c]);
            *out.imposed -= at.inputs.carrier_speed * self.amplitude * self.teeth * wave * at.v[c];
        } else {
            *out.drive += at.inputs.carrier_torque * self.amplitude * wave;
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
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

    fn scales_carrier_inputs(&self) -> bool {
        self.amplitude != 0.0
    }

    fn carrier_speed(&self, q: &[f64], command: f64) -> f64 {
        if self.imposed { command * (1.0 + self.amplitude * cos(self.teeth * q[CARRIER])) } else { command }
    }
}

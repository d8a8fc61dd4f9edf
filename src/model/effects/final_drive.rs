//! Excitation by the final drive. The carrier's torque or imposed speed varies at the mesh order z of the ring gear,
//! T = T₀ (1 + ε sin zθ) or ω = ω₀ (1 + ε cos zθ): the first harmonic of a gear pair's mesh excitation.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{Action, BodyEffect, BodyMotion, Declare, Effect, Setting, Slopes};
use crate::model::scene::{CARRIER, Inputs, Plan};
use crate::numeric::{Jet, Scalar};

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

impl Excitation {
    /// Change of the commanded torque at the `angle` of the carrier, relative to the command.
    fn of_torque<T: Scalar>(&self, angle: T) -> T {
        (angle * self.teeth).sin() * self.amplitude
    }

    /// Change of the commanded speed at the `angle` of the carrier, relative to the command.
    fn of_speed<T: Scalar>(&self, angle: T) -> T {
        (angle * self.teeth).cos() * self.amplitude
    }
}

impl BodyEffect for Excitation {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        let c = at.layout.carrier();
        let angle = Jet::variable(at.q[c]);
        if self.imposed {
            let wave = self.of_speed(angle);
            *out.imposed += at.input_rates.carrier_speed * wave.v + at.inputs.carrier_speed * wave.d * at.v[c];
        } else {
            *out.drive += at.inputs.carrier_torque * self.of_torque(angle).v;
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        let c = at.layout.carrier();
        let (angle, Inputs { carrier_speed: speed, carrier_torque: torque, .. }) = (Jet::variable(at.q[c]), at.inputs);
        if self.imposed {
            let wave = self.of_speed(angle);
            out.imposed[0][c] += at.input_rates.carrier_speed * wave.d + speed * wave.dd * at.v[c];
            out.imposed[1][c] += speed * wave.d;
        } else {
            out.position(c, c, torque * self.of_torque(angle).d);
        }
    }

    fn scales_carrier_inputs(&self) -> bool {
        self.amplitude != 0.0
    }

    fn carrier_speed(&self, q: &[f64], command: f64) -> f64 {
        if self.imposed { command * (1.0 + self.of_speed(q[CARRIER])) } else { command }
    }
}

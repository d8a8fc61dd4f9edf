//! Drag of bearings and churned oil: T = T₀ tanh(ω/ω₀) + b ω + c ω |ω| on the carrier, the first two on the side gears.
//!
//! The three parts of the SKF model in their plainest form: load-independent bearing torque, viscous drag, and churning
//! with the square of the speed (ISO/TR 14179-1).

use super::super::causes::Cause;
use super::super::effect_specs::BearingDragSpec;
use super::Setting;
use super::body::{Action, Bodies, BodyEffect, Slopes};

/// Drag on carrier and side gears.
#[derive(Clone, Copy, Debug)]
pub struct BearingDrag {
    spec: BearingDragSpec,
}

impl BearingDrag {
    /// Drag of the scene.
    pub fn new(setting: &Setting) -> Self {
        Self { spec: setting.parameters.specs.bearing_drag }
    }

    /// Torque against the rotation of body `i` and its slope by the speed.
    fn drag(&self, at: &Bodies, i: usize) -> (f64, f64) {
        let spec = &self.spec;
        let (coulomb, viscous, churning) = if i == at.layout.carrier() {
            (spec.carrier_torque, spec.carrier_viscous, spec.carrier_churning)
        } else {
            (spec.side_torque, spec.side_viscous, 0.0)
        };
        let v = at.v[i];
        let t = libm::tanh(v / spec.breakaway_speed);
        (
            coulomb * t + viscous * v + churning * v * v.abs(),
            coulomb * (1.0 - t * t) / spec.breakaway_speed + viscous + 2.0 * churning * v.abs(),
        )
    }
}

impl BodyEffect for BearingDrag {
    fn act(&self, at: &Bodies, out: &mut Action) {
        for i in 0..3 {
            let (torque, _) = self.drag(at, i);
            out.force[i] -= torque;
            out.heat[Cause::Drag as usize] += torque * at.v[i];
        }
    }

    fn slopes(&self, at: &Bodies, out: &mut Slopes) {
        for i in 0..3 {
            out.velocity(i, i, -self.drag(at, i).1);
        }
    }
}

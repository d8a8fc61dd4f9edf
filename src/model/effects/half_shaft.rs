//! Torsion of the half-shafts: T = k φ + c φ̇ with the twist φ = θ_s − θ_end between side gear and wheel.
//!
//! Kelvin–Voigt element of a uniform shaft, k = G I_p / L.

use super::super::causes::Cause;
use super::super::effect_specs::HalfShaftSpec;
use super::Setting;
use super::body::{Action, Bodies, BodyEffect, Slopes};

/// The half-shafts that have an end of their own.
#[derive(Clone, Copy, Debug)]
pub struct HalfShafts {
    spec: HalfShaftSpec,
}

impl HalfShafts {
    /// Half-shafts of the scene.
    pub fn new(setting: &Setting) -> Self {
        let mut spec = setting.parameters.specs.half_shaft;
        // a rigid side has neither twist nor torque of its own
        for s in 0..2 {
            if !setting.plan.shafts[s] {
                (spec.stiffness[s], spec.damping[s]) = (0.0, 0.0);
            }
        }
        Self { spec }
    }

    /// Torque that the shaft of side `s` hands to the wheel [N·m].
    pub fn torque(spec: &HalfShaftSpec, at: &Bodies, s: usize) -> f64 {
        let end = at.layout.end(s);
        spec.stiffness[s] * at.q[end] + spec.damping[s] * (at.v[s] - at.v[end])
    }
}

impl BodyEffect for HalfShafts {
    fn act(&self, at: &Bodies, out: &mut Action) {
        for s in 0..2 {
            let end = at.layout.end(s);
            let torque = Self::torque(&self.spec, at, s);
            out.force[s] -= torque;
            out.force[end] += torque;
            let rate = at.v[s] - at.v[end];
            out.heat[Cause::Shaft as usize] += self.spec.damping[s] * rate * rate;
        }
    }

    fn slopes(&self, at: &Bodies, out: &mut Slopes) {
        for s in 0..2 {
            let end = at.layout.end(s);
            let (k, c) = (self.spec.stiffness[s], self.spec.damping[s]);
            out.position(s, end, -k);
            out.position(end, end, k);
            out.velocity(s, s, -c);
            out.velocity(s, end, c);
            out.velocity(end, s, c);
            out.velocity(end, end, -c);
        }
    }

    fn energy(&self, at: &Bodies) -> f64 {
        (0..2)
            .map(|s| {
                let twist = at.q[at.layout.end(s)];
                0.5 * self.spec.stiffness[s] * twist * twist
            })
            .sum()
    }
}

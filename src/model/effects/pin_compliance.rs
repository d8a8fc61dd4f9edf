//! Pins that bend and a case that gives way, in series with the teeth.
//!
//! A planet turns about the carrier's axis by β beyond its carrier: T = k_p r² (β + τ β̇), r = R_m cosδ_p the distance of
//! its meshes from that axis. A side gear moves by w away from the apex under its thrust: F = k_c (w + τ ẇ). Linear springs
//! with damping proportional to stiffness.

use super::super::causes::Cause;
use super::Setting;
use super::body::{Action, Bodies, BodyEffect, Slopes};
use crate::integrate::in_pairs;
use crate::numeric::cos;

/// Springs of pins and case.
#[derive(Clone, Copy, Debug)]
pub struct PinCompliance {
    pin: f64,
    case: f64,
    time: f64,
}

impl PinCompliance {
    /// Springs of the scene.
    pub fn new(setting: &Setting) -> Self {
        let spec = &setting.parameters.specs.pin_compliance;
        let arm = setting.pair.mean_cone * cos(setting.pair.gears[0].pitch);
        Self { pin: spec.pin_stiffness * arm * arm, case: spec.case_stiffness, time: spec.damping_time }
    }
}

impl BodyEffect for PinCompliance {
    fn act(&self, at: &Bodies, out: &mut Action) {
        let layout = at.layout;
        let carrier = layout.carrier();
        let mut pins = [0.0; 4];
        let mut heat = [0.0; 4];
        for g in 0..layout.groups {
            let i = layout.pin(g);
            let rate = at.v[i] - at.v[carrier];
            let torque = self.pin * (at.q[i] + self.time * rate);
            out.force[i] -= torque;
            pins[g] = layout.members[g] * torque;
            heat[g] = layout.members[g] * self.pin * self.time * rate * rate;
        }
        out.force[carrier] += in_pairs(layout.groups, |g| pins[g]);
        out.heat[Cause::Support as usize] += in_pairs(layout.groups, |g| heat[g]);
        for s in 0..2 {
            let i = layout.seat(s);
            out.force[i] -= self.case * (at.q[i] + self.time * at.v[i]);
            out.heat[Cause::Support as usize] += self.case * self.time * at.v[i] * at.v[i];
        }
    }

    fn slopes(&self, at: &Bodies, out: &mut Slopes) {
        let layout = at.layout;
        let (carrier, c) = (layout.carrier(), self.pin * self.time);
        for g in 0..layout.groups {
            let (i, m) = (layout.pin(g), layout.members[g]);
            out.position(i, i, -self.pin);
            out.velocity(i, i, -c);
            out.velocity(i, carrier, c);
            out.position(carrier, i, m * self.pin);
            out.velocity(carrier, i, m * c);
        }
        out.velocity(carrier, carrier, -in_pairs(layout.groups, |g| layout.members[g] * c));
        for s in 0..2 {
            let i = layout.seat(s);
            out.position(i, i, -self.case);
            out.velocity(i, i, -self.case * self.time);
        }
    }

    fn is_structure(&self) -> bool {
        true
    }

    fn energy(&self, at: &Bodies) -> f64 {
        let layout = at.layout;
        let square = |i: usize| at.q[i] * at.q[i];
        let pins = in_pairs(layout.groups, |g| layout.members[g] * self.pin * square(layout.pin(g)));
        0.5 * (pins + self.case * (square(layout.seat(0)) + square(layout.seat(1))))
    }
}

//! Elastic pins and an elastic case, in series with the teeth.
//!
//! A planet leads its carrier by the angle β about the carrier's axis: T = k_p r² (β + τ β̇), where r = R_m cosδ_p is
//! the distance of its meshes from that axis. A side gear moves by w away from the apex under its thrust: F = k_c (w +
//! τ ẇ). The springs are linear, with damping proportional to stiffness.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{
    Action, BodyEffect, BodyMotion, Declare, Effect, Heat, Needs, Setting, Slopes, ToothEffects,
};
use crate::model::scene::layout::over_groups;
use crate::model::scene::{GearContact, Plan, Requests};
use crate::numeric::cos;
use crate::problem::Problem;

parameters! {
    /// Compliance of pins and case, in series with the teeth.
    pub struct PinComplianceSpec in "pin_compliance" {
        /// Stiffness of a pin against the tangential force of its planet
        pin_stiffness: f64 = 5e8, N_PER_M | N_PER_UM, 1e3..=1e13;
        /// Stiffness of the case against the thrust of a side gear
        case_stiffness: f64 = 1e9, N_PER_M | N_PER_UM, 1e3..=1e13;
        /// Ratio of damping to stiffness of pins and case
        damping_time: f64 = 1e-6, SECOND, 0.0..=1.0;
    }
}

impl Declare for PinComplianceSpec {
    const DESCRIPTION: &'static str = "Elastic pins and case, in series with the teeth";
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.support",
        description: "Heat of damping in pins and case since the start",
        at_wheels: false,
    });
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth],
        why: "it follows from the forces of the meshes along the axes and across the pins",
    });

    fn needs() -> Vec<(Need, Condition)> {
        vec![(Need::AxialMass, on!(Self))]
    }
}

impl Effect for PinComplianceSpec {
    fn requests(&self, _: &Setting) -> Requests {
        Requests { pins: true, ..Requests::default() }
    }

    fn on_teeth(&self, _: &Setting, teeth: &mut ToothEffects) -> Result<(), Problem> {
        // a seat that moves along its axis changes the gap over the face
        teeth.distributed = true;
        Ok(())
    }

    fn on_bodies(&self, setting: &Setting, _: &Plan) -> Option<Box<dyn BodyEffect>> {
        let arm = setting.pair.mean_cone * cos(setting.pair.gears[0].pitch);
        let (pin, case) = (self.pin_stiffness * arm * arm, self.case_stiffness);
        Some(Box::new(Springs { pin, case, time: self.damping_time, heat_index: setting.heat_index }))
    }
}

/// Springs of pins and case.
#[derive(Clone, Copy, Debug)]
struct Springs {
    /// Stiffness k_p r² of a pin [N·m/rad].
    pin: f64,
    /// Stiffness k_c of the case [N/m].
    case: f64,
    /// Damping over stiffness τ [s].
    time: f64,
    heat_index: usize,
}

impl BodyEffect for Springs {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
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
        out.force[carrier] += over_groups(layout.groups, |g| pins[g]);
        out.heat[self.heat_index] += over_groups(layout.groups, |g| heat[g]);
        for s in 0..2 {
            let i = layout.seat(s);
            out.force[i] -= self.case * (at.q[i] + self.time * at.v[i]);
            out.heat[self.heat_index] += self.case * self.time * at.v[i] * at.v[i];
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
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
        out.velocity(carrier, carrier, -over_groups(layout.groups, |g| layout.members[g] * c));
        for s in 0..2 {
            let i = layout.seat(s);
            out.position(i, i, -self.case);
            out.velocity(i, i, -self.case * self.time);
        }
    }

    fn is_structure(&self) -> bool {
        true
    }

    fn energy(&self, at: &BodyMotion) -> f64 {
        let layout = at.layout;
        let square = |i: usize| at.q[i] * at.q[i];
        let pins = over_groups(layout.groups, |g| layout.members[g] * self.pin * square(layout.pin(g)));
        0.5 * (pins + self.case * (square(layout.seat(0)) + square(layout.seat(1))))
    }
}

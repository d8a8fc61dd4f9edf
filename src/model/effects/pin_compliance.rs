//! Elastic pins and an elastic case, in series with the teeth.
//!
//! A planet leads its carrier by the angle β about the carrier's axis: T = k_p r² (β + τ β̇), where r = R_m cosδ_p is
//! the distance of its meshes from that axis. A side gear moves by w away from the apex under its thrust: F = k_c (w +
//! τ ẇ). The springs are linear, with damping proportional to stiffness.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{
    BodyEffect, Declare, Effect, EffectSetting, Element, Heat, Needs, Part, Spring, ToothEffects, Warmed,
};
use crate::model::scene::{GearContact, Plan, Requests};
use crate::model::thermal::CASE;
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
        warms: Warmed::Node(CASE),
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
    fn requests(&self, _: &EffectSetting) -> Requests {
        Requests { pins: true, ..Requests::default() }
    }

    fn on_teeth(&self, _: &EffectSetting, teeth: &mut ToothEffects) -> Result<(), Problem> {
        // a seat that moves along its axis changes the gap over the face
        teeth.distributed = true;
        Ok(())
    }

    fn on_bodies(&self, setting: &EffectSetting, plan: &Plan) -> Option<Box<dyn BodyEffect>> {
        let (layout, arm) = (plan.layout(), setting.pair.mean_cone * cos(setting.pair.gears[0].pitch));
        let spring = |stiffness: f64, i: usize, base: Option<usize>| {
            let law = Spring { stiffness, damping: stiffness * self.damping_time };
            Part { law, displacement: Some(i), body: i, base }
        };
        let (pin, carrier) = (self.pin_stiffness * arm * arm, Some(layout.carrier()));
        let pins = (0..layout.groups).map(|g| spring(pin, layout.pin(g), carrier));
        let seats = (0..2).map(|s| spring(self.case_stiffness, layout.seat(s), None));
        let (parts, groups, members) = (pins.chain(seats).collect(), layout.groups, layout.members);
        Some(Box::new(Element { parts, groups, members, is_structure: true, heat_index: setting.heat_index }))
    }
}

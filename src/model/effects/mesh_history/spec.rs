//! Declaration of the effect: its readings. It has no parameters.

use crate::declaration::Condition;
use crate::declaration::units::{self, DEG_PER_S, MM};
use crate::model::effect_kinds::{Changes, Declare, Effect, Needs, Reading};
use crate::model::scene::GearContact;

/// Reading of the peak-to-peak value of an output.
macro_rules! peaks {
    ($name:literal, $what:literal, $unit:ident, $display:ident) => {
        Reading {
            name: concat!($name, "_peak_to_peak"),
            unit: units::$unit,
            display: Some($display),
            changes: Changes::ByStep,
            description: concat!(
                "Peak-to-peak ",
                $what,
                " over the last whole mesh cycle; 0 before the first cycle has ended, and in model exchange"
            ),
        }
    };
}

parameters! {
    /// Peak-to-peak values over mesh cycles.
    pub struct MeshHistorySpec in "mesh_history" {}
}

impl Declare for MeshHistorySpec {
    const DESCRIPTION: &'static str =
        "Peak-to-peak side speeds and transmission errors over the last whole mesh cycle; co-simulation only";
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth, GearContact::Solid],
        why: "it follows from the motion of teeth against each other",
    });
    const READINGS: &'static [Reading] = &[
        peaks!("left.speed", "value of left.speed", RAD_PER_S, DEG_PER_S),
        peaks!("right.speed", "value of right.speed", RAD_PER_S, DEG_PER_S),
        peaks!("planet[1].left_transmission_error", "transmission error to the left side gear", METRE, MM),
        peaks!("planet[1].right_transmission_error", "transmission error to the right side gear", METRE, MM),
        peaks!("planet[2].left_transmission_error", "transmission error to the left side gear", METRE, MM),
        peaks!("planet[2].right_transmission_error", "transmission error to the right side gear", METRE, MM),
        peaks!("planet[3].left_transmission_error", "transmission error to the left side gear", METRE, MM),
        peaks!("planet[3].right_transmission_error", "transmission error to the right side gear", METRE, MM),
        peaks!("planet[4].left_transmission_error", "transmission error to the left side gear", METRE, MM),
        peaks!("planet[4].right_transmission_error", "transmission error to the right side gear", METRE, MM),
    ];

    fn when() -> Option<Condition> {
        Some(Condition::OwnSteps)
    }
}

impl Effect for MeshHistorySpec {}

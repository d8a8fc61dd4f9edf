//! Declaration of the effect: its readings. It has no parameters.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{Class, Declare, Effect, Needs, Reading, readings};
use crate::model::scene::GearContact;

parameters! {
    /// Peak-to-peak values over mesh cycles.
    pub struct MeshHistorySpec in "mesh_history" {}
}

impl Declare for MeshHistorySpec {
    const DESCRIPTION: &'static str =
        "Peak-to-peak side speeds and transmission errors over the last whole mesh cycle; co-simulation only";
    const CLASS: Class = Class::Outputs;
    const RECORDS_STEPS: bool = true;
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth, GearContact::Solid],
        why: "it follows from the motion of teeth against each other",
    });
    const READINGS: &'static [Reading] = readings! {
        /// Peak-to-peak value of left.speed over the last whole mesh cycle; 0 before the first cycle has ended, and in
        /// model exchange
        "left.speed_peak_to_peak": RAD_PER_S | DEG_PER_S, ByStep;
        /// Peak-to-peak value of right.speed over the last whole mesh cycle; 0 before the first cycle has ended, and
        /// in model exchange
        "right.speed_peak_to_peak": RAD_PER_S | DEG_PER_S, ByStep;
        /// Peak-to-peak transmission error to the left side gear over the last whole mesh cycle; 0 before the first
        /// cycle has ended, and in model exchange
        "planet[1].left_transmission_error_peak_to_peak": METRE | MM, ByStep;
        /// Peak-to-peak transmission error to the right side gear over the last whole mesh cycle; 0 before the first
        /// cycle has ended, and in model exchange
        "planet[1].right_transmission_error_peak_to_peak": METRE | MM, ByStep;
        /// Peak-to-peak transmission error to the left side gear over the last whole mesh cycle; 0 before the first
        /// cycle has ended, and in model exchange
        "planet[2].left_transmission_error_peak_to_peak": METRE | MM, ByStep;
        /// Peak-to-peak transmission error to the right side gear over the last whole mesh cycle; 0 before the first
        /// cycle has ended, and in model exchange
        "planet[2].right_transmission_error_peak_to_peak": METRE | MM, ByStep;
        /// Peak-to-peak transmission error to the left side gear over the last whole mesh cycle; 0 before the first
        /// cycle has ended, and in model exchange
        "planet[3].left_transmission_error_peak_to_peak": METRE | MM, ByStep;
        /// Peak-to-peak transmission error to the right side gear over the last whole mesh cycle; 0 before the first
        /// cycle has ended, and in model exchange
        "planet[3].right_transmission_error_peak_to_peak": METRE | MM, ByStep;
        /// Peak-to-peak transmission error to the left side gear over the last whole mesh cycle; 0 before the first
        /// cycle has ended, and in model exchange
        "planet[4].left_transmission_error_peak_to_peak": METRE | MM, ByStep;
        /// Peak-to-peak transmission error to the right side gear over the last whole mesh cycle; 0 before the first
        /// cycle has ended, and in model exchange
        "planet[4].right_transmission_error_peak_to_peak": METRE | MM, ByStep;
    };

    fn when() -> Option<Condition> {
        Some(Condition::OwnSteps)
    }
}

impl Effect for MeshHistorySpec {}

//! Declaration of the effect: its readings. It has no parameters.

use serde::{Deserialize, Serialize};

use crate::declaration::units::{self, DEG_PER_S, MM};
use crate::declaration::{Parameter, Row};
use crate::model::effect_kinds::effect::{Changes, Declare, Effect, Needs, Reading};
use crate::model::scene::GearContact;

/// Peak-to-peak values over mesh cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeshHistorySpec;

impl Declare for MeshHistorySpec {
    const WHEN: Option<&'static str> = Some("co-simulation");
    const DESCRIPTION: &'static str =
        "Peak-to-peak side speeds and transmission errors over the last whole mesh cycle; co-simulation only";
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth, GearContact::Solid],
        why: "it follows from the motion of teeth against each other",
    });
    const READINGS: &'static [Reading] = &[
        speed(
            "left.speed_peak_to_peak",
            "Peak-to-peak value of left.speed over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        speed(
            "right.speed_peak_to_peak",
            "Peak-to-peak value of right.speed over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        transmission_error(
            "planet[1].left_transmission_error_peak_to_peak",
            "Peak-to-peak value of the transmission error to the left side gear over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        transmission_error(
            "planet[1].right_transmission_error_peak_to_peak",
            "Peak-to-peak value of the transmission error to the right side gear over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        transmission_error(
            "planet[2].left_transmission_error_peak_to_peak",
            "Peak-to-peak value of the transmission error to the left side gear over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        transmission_error(
            "planet[2].right_transmission_error_peak_to_peak",
            "Peak-to-peak value of the transmission error to the right side gear over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        transmission_error(
            "planet[3].left_transmission_error_peak_to_peak",
            "Peak-to-peak value of the transmission error to the left side gear over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        transmission_error(
            "planet[3].right_transmission_error_peak_to_peak",
            "Peak-to-peak value of the transmission error to the right side gear over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        transmission_error(
            "planet[4].left_transmission_error_peak_to_peak",
            "Peak-to-peak value of the transmission error to the left side gear over the last whole mesh cycle; 0 before, and in model exchange",
        ),
        transmission_error(
            "planet[4].right_transmission_error_peak_to_peak",
            "Peak-to-peak value of the transmission error to the right side gear over the last whole mesh cycle; 0 before, and in model exchange",
        ),
    ];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        Vec::new()
    }
}

impl Effect for MeshHistorySpec {}

const fn speed(name: &'static str, description: &'static str) -> Reading {
    Reading { name, unit: units::RAD_PER_S, display: Some(DEG_PER_S), changes: Changes::ByStep, description }
}

const fn transmission_error(name: &'static str, description: &'static str) -> Reading {
    Reading { name, unit: units::METRE, display: Some(MM), changes: Changes::ByStep, description }
}

//! Declaration of the effect: its parameters and readings.

use crate::declaration::Condition;
use crate::declaration::units::*;
use crate::model::effect_kinds::{Changes, Declare, Effect, Reading};

parameters! {
    /// Advice about the communication step.
    pub struct CouplingAdviceSpec in "coupling" {
        /// Delay of the host's answer in communication steps: 0 if it reads angle and speed at the start of a step and
        /// answers at once, 1 if it answers one step later
        host_delay: f64 = 0.0, ONE, -0.5..=1.0;
        /// Energy ratio at which coupling.step_advice aims
        wanted_ratio: f64 = 0.01, ONE, 1e-9..=1.0;
    }
}

/// Reading of the energy that the cut at a port has created.
macro_rules! energy {
    ($name:literal, $of:literal) => {
        Reading {
            name: concat!("coupling.", $name, ".energy_error"),
            unit: JOULE,
            display: None,
            changes: Changes::ByStep,
            description: concat!(
                "Energy that the cut between host and unit has created (+) or destroyed (-) ",
                $of,
                " since the start; 0 in model exchange"
            ),
        }
    };
}

impl Declare for CouplingAdviceSpec {
    const DESCRIPTION: &'static str =
        "Advice about the communication step, from the energy error of the cut; co-simulation only";
    const READINGS: &'static [Reading] = &[
        energy!("carrier", "at a carrier driven by torque"),
        energy!("left", "at the left wheel"),
        energy!("right", "at the right wheel"),
        Reading {
            name: "coupling.energy_ratio",
            unit: ONE,
            display: None,
            changes: Changes::ByStep,
            description: "Largest ratio of a port: magnitude of the energy errors of its cut divided by the energy through it, as \
                          sums that decay over about two periods of the motion",
        },
        Reading {
            name: "coupling.step_advice",
            unit: SECOND,
            display: None,
            changes: Changes::ByStep,
            description: "Communication step at which coupling.energy_ratio would be coupling.wanted_ratio, at most the longest \
                          stable step; coupling.advice_state says what 0 means",
        },
        Reading {
            name: "coupling.advice_state",
            unit: ONE,
            display: None,
            changes: Changes::ByStep,
            description: "Meaning of coupling.step_advice: 1 = given, 2 = nothing moves, 3 = no host reacts, 4 = not possible for \
                          this master, 5 = unstable cut",
        },
    ];

    fn when() -> Option<Condition> {
        Some(Condition::OwnSteps)
    }
}

impl Effect for CouplingAdviceSpec {}

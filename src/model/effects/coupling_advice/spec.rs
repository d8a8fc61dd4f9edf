//! Declaration of the effect: its parameters and readings.

use crate::declaration::{Parameter, Row, row, units};
use crate::model::effect_kinds::{Changes, Declare, Effect, Reading};

spec! {
    /// Advice about the communication step.
    pub struct CouplingAdviceSpec {
        /// Delay of the host's answer in communication steps, from −0.5 to 1.
        pub host_delay: f64 = 0.0,
        /// Energy ratio at which the advised step aims.
        pub wanted_ratio: f64 = 0.01,
    }
}

/// Reading of the energy that the cut at a port has created.
macro_rules! energy {
    ($name:literal, $of:literal) => {
        Reading {
            name: concat!("coupling.", $name, ".energy_error"),
            unit: units::JOULE,
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
    const WHEN: Option<&'static str> = Some("co-simulation");
    const DESCRIPTION: &'static str =
        "Advice about the communication step, from the energy error of the cut; co-simulation only";
    const READINGS: &'static [Reading] = &[
        energy!("carrier", "at a carrier driven by torque"),
        energy!("left", "at the left wheel"),
        energy!("right", "at the right wheel"),
        Reading {
            name: "coupling.energy_ratio",
            unit: units::ONE,
            display: None,
            changes: Changes::ByStep,
            description: "Largest ratio of a port: magnitude of the energy errors of its cut divided by the energy through it, as \
                          sums that decay over about two periods of the motion",
        },
        Reading {
            name: "coupling.step_advice",
            unit: units::SECOND,
            display: None,
            changes: Changes::ByStep,
            description: "Communication step at which coupling.energy_ratio would be coupling.wanted_ratio, at most the longest \
                          stable step; coupling.advice_state says what 0 means",
        },
        Reading {
            name: "coupling.advice_state",
            unit: units::ONE,
            display: None,
            changes: Changes::ByStep,
            description: "Meaning of coupling.step_advice: 1 = given, 2 = nothing moves, 3 = no host reacts, 4 = not possible for \
                          this master, 5 = unstable cut",
        },
    ];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        vec![
            row(
                "coupling.host_delay",
                "Delay of the host's answer in communication steps: 0 if it reads angle and speed at the start of a \
                 step and answers at once, 1 if it answers one step later",
            )
            .real(units::ONE, (-0.5, 1.0), |p| &mut p.host_delay),
            row("coupling.wanted_ratio", "Energy ratio at which coupling.step_advice aims").real(
                units::ONE,
                (1e-9, 1.0),
                |p| &mut p.wanted_ratio,
            ),
        ]
    }
}

impl Effect for CouplingAdviceSpec {}

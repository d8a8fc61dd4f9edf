//! Declaration of the effect: its parameters and readings.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{Class, Declare, Effect, Reading, readings};

choices! {
    /// Meaning of the advised step.
    pub enum AdviceState: "AdviceState" {
        Off = 0, "off": "effects.coupling_advice is off, or the host integrates (model exchange)";
        Given = 1, "given": "the advised step is given";
        NothingMoves = 2, "nothing_moves": "0, because nothing moves";
        NoReaction = 3, "no_reaction": "0, because no host reacts";
        NotPossible = 4, "not_possible": "0, because the exchange of this master has no energy error";
        UnstableCut = 5, "unstable_cut": "a swing grows by the cut; the advised step is at most half the present one";
    }
}

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

impl Declare for CouplingAdviceSpec {
    const DESCRIPTION: &'static str =
        "Advice about the communication step, from the energy error of the cut; co-simulation only";
    const CLASS: Class = Class::Outputs;
    const READINGS: &'static [Reading] = readings! {
        /// Energy that the cut has created (+) or destroyed (-) at a carrier driven by torque since the start; 0 in
        /// model exchange
        "coupling.carrier.energy_error": JOULE, ByStep;
        /// Energy that the cut has created (+) or destroyed (-) at the left wheel since the start; 0 in model exchange
        "coupling.left.energy_error": JOULE, ByStep;
        /// Energy that the cut has created (+) or destroyed (-) at the right wheel since the start; 0 in model exchange
        "coupling.right.energy_error": JOULE, ByStep;
        /// Largest energy error of a cut over the energy through it; sums that decay over about two periods of the
        /// motion
        "coupling.energy_ratio": ONE, ByStep;
        /// Communication step at which coupling.energy_ratio would be coupling.wanted_ratio, at most the present one;
        /// coupling.advice_state says what 0 means
        "coupling.step_advice": SECOND, ByStep;
        /// Meaning of coupling.step_advice
        "coupling.advice_state": ONE, ByStep, AdviceState;
    };

    fn when() -> Option<Condition> {
        Some(Condition::OwnSteps)
    }
}

impl Effect for CouplingAdviceSpec {}

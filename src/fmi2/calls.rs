//! Which call is legal in which state: the tables of FMI 2.0.4, sections 3.2.3 (model exchange) and 4.2.4 (co-simulation).
//!
//! Both kinds share the states before the start and after the end; in between each has states of its own, so that one
//! table serves both. Calls of one kind that are legal in a shared state ask for the kind as well.

use serde::{Deserialize, Serialize};

use super::refusal::{Answer, Refusal};

/// State of an instance as FMI counts states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Phase {
    /// After fmi2Instantiate or fmi2Reset.
    Instantiated = 0,
    /// Between fmi2EnterInitializationMode and fmi2ExitInitializationMode.
    Initialization = 1,
    /// Ready for fmi2DoStep.
    StepComplete = 2,
    /// fmi2DoStep was discarded; values are those of the last good time.
    StepFailed = 3,
    /// After fmi2Terminate.
    Terminated = 4,
    /// Initialisation failed, or an internal error.
    Error = 5,
    /// Model exchange, at an event.
    Event = 6,
    /// Model exchange, between events.
    ContinuousTime = 7,
}

impl Phase {
    pub(super) const ALL: [Self; 8] = {
        use Phase::*;
        [Instantiated, Initialization, StepComplete, StepFailed, Event, ContinuousTime, Terminated, Error]
    };

    /// Whether a simulation has been started and goes on.
    pub fn is_running(self) -> bool {
        matches!(self, Self::StepComplete | Self::Event | Self::ContinuousTime)
    }

    /// Name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initialization mode",
            Self::StepComplete => "step complete",
            Self::StepFailed => "step failed",
            Self::Terminated => "terminated",
            Self::Error => "error",
            Self::Event => "event mode",
            Self::ContinuousTime => "continuous-time mode",
        }
    }
}

const INST: u8 = 1 << Phase::Instantiated as u8;
const INIT: u8 = 1 << Phase::Initialization as u8;
const DONE: u8 = 1 << Phase::StepComplete as u8;
const FAILED: u8 = 1 << Phase::StepFailed as u8;
const END: u8 = 1 << Phase::Terminated as u8;
const ERROR: u8 = 1 << Phase::Error as u8;
/// fmi2CancelStep and the statuses of a pending step: steps are synchronous, so no state of ours is "step in progress".
const NEVER: u8 = 0;
const EVENT: u8 = 1 << Phase::Event as u8;
const FLOW: u8 = 1 << Phase::ContinuousTime as u8;
const ALWAYS: u8 = INST | INIT | DONE | FAILED | EVENT | FLOW | END | ERROR;

macro_rules! calls {
    ($($call:ident $name:literal $phases:expr;)+) => {
        /// A call that is legal in some states only.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs)]
        pub enum Call { $($call),+ }

        impl Call {
            /// All of them.
            #[cfg(test)]
            pub const ALL: &[Self] = &[$(Self::$call),+];

            /// Name of the C function.
            pub fn name(self) -> &'static str {
                match self { $(Self::$call => $name),+ }
            }

            /// States in which the call is legal, a bit each.
            fn phases(self) -> u8 {
                match self { $(Self::$call => $phases),+ }
            }
        }
    };
}

calls! {
    SetDebugLogging          "fmi2SetDebugLogging"          ALWAYS;
    SetupExperiment          "fmi2SetupExperiment"          INST;
    EnterInitializationMode  "fmi2EnterInitializationMode"  INST;
    ExitInitializationMode   "fmi2ExitInitializationMode"   INIT;
    Terminate                "fmi2Terminate"                DONE | FAILED | EVENT | FLOW;
    Reset                    "fmi2Reset"                    ALWAYS;
    GetReal                  "fmi2GetReal"                  ALWAYS; // outputs not in `instantiated`, see `values`
    GetInteger               "fmi2GetInteger"               ALWAYS;
    GetBoolean               "fmi2GetBoolean"               ALWAYS;
    GetString                "fmi2GetString"                ALWAYS;
    SetReal                  "fmi2SetReal"                  INST | INIT | DONE | EVENT | FLOW; // see `values`
    SetInteger               "fmi2SetInteger"               INST | INIT | DONE | EVENT;
    SetBoolean               "fmi2SetBoolean"               INST | INIT | DONE | EVENT;
    SetString                "fmi2SetString"                INST | INIT | DONE | EVENT;
    GetFmuState              "fmi2GetFMUstate"              ALWAYS & !ERROR; // an erroneous state is not worth keeping
    SetFmuState              "fmi2SetFMUstate"              ALWAYS;
    FreeFmuState             "fmi2FreeFMUstate"             ALWAYS;
    SerializedFmuStateSize   "fmi2SerializedFMUstateSize"   ALWAYS;
    SerializeFmuState        "fmi2SerializeFMUstate"        ALWAYS;
    DeSerializeFmuState      "fmi2DeSerializeFMUstate"      ALWAYS;
    GetDirectionalDerivative "fmi2GetDirectionalDerivative" ALWAYS & !INST;
    SetRealInputDerivatives  "fmi2SetRealInputDerivatives"  INST | INIT | DONE;
    GetRealOutputDerivatives "fmi2GetRealOutputDerivatives" DONE | FAILED | END | ERROR;
    DoStep                   "fmi2DoStep"                   DONE;
    CancelStep               "fmi2CancelStep"               NEVER;
    GetStatus                "fmi2GetStatus"                DONE | FAILED | END;
    GetRealStatus            "fmi2GetRealStatus"            DONE | FAILED | END;
    GetIntegerStatus         "fmi2GetIntegerStatus"         DONE | FAILED | END;
    GetBooleanStatus         "fmi2GetBooleanStatus"         DONE | FAILED | END;
    GetStringStatus          "fmi2GetStringStatus"          DONE | FAILED | END;
    EnterEventMode           "fmi2EnterEventMode"           FLOW;
    NewDiscreteStates        "fmi2NewDiscreteStates"        EVENT;
    EnterContinuousTimeMode  "fmi2EnterContinuousTimeMode"  EVENT;
    CompletedIntegratorStep  "fmi2CompletedIntegratorStep"  FLOW;
    SetTime                  "fmi2SetTime"                  EVENT | FLOW;
    SetContinuousStates      "fmi2SetContinuousStates"      FLOW;
    GetDerivatives           "fmi2GetDerivatives"           INIT | EVENT | FLOW | END | ERROR;
    GetEventIndicators       "fmi2GetEventIndicators"       INIT | EVENT | FLOW | END | ERROR;
    GetContinuousStates      "fmi2GetContinuousStates"      INIT | EVENT | FLOW | END | ERROR;
    GetNominals              "fmi2GetNominalsOfContinuousStates" ALWAYS;
}

impl Call {
    /// Whether the call is legal in `phase`.
    pub fn legal(self, phase: Phase) -> bool {
        self.phases() & (1 << phase as u8) != 0
    }

    /// Refuses a call out of order, naming call and state.
    pub fn check(self, phase: Phase) -> Answer {
        if self.legal(phase) {
            return Ok(());
        }
        let legal: Vec<_> = Phase::ALL.into_iter().filter(|&p| self.legal(p)).map(Phase::name).collect();
        let states =
            if legal.is_empty() { "no state of this FMU".into() } else { format!("\"{}\"", legal.join("\", \"")) };
        Err(Refusal::error(format!("not legal in the state \"{}\"; legal in {states}", phase.name())))
    }
}

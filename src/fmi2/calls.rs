//! Which call is legal in which state: the tables of FMI 2.0.4, sections 3.2.3 (model exchange) and 4.2.4 (co-simulation).
//!
//! Both kinds share the states before the start and after the end; in between, each has its own states, so one table
//! serves both. Calls of one kind that are legal in a shared state also check the kind.

use serde::{Deserialize, Serialize};

use super::{CallError, CallResult};

/// State of an instance in FMI's state machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Phase {
    /// After fmi2Instantiate or fmi2Reset.
    Instantiated = 0,
    /// Between fmi2EnterInitializationMode and fmi2ExitInitializationMode.
    Initialization = 1,
    /// Ready for fmi2DoStep.
    StepComplete = 2,
    /// fmi2DoStep was discarded; values are those of the last successful time.
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

    /// Whether a simulation runs.
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
const COMPLETE: u8 = 1 << Phase::StepComplete as u8;
const FAILED: u8 = 1 << Phase::StepFailed as u8;
const TERMINATED: u8 = 1 << Phase::Terminated as u8;
const ERROR: u8 = 1 << Phase::Error as u8;
/// For fmi2CancelStep: steps are synchronous, so no instance is ever in the state "step in progress".
const NEVER: u8 = 0;
const EVENT: u8 = 1 << Phase::Event as u8;
const CONTINUOUS: u8 = 1 << Phase::ContinuousTime as u8;
const ALWAYS: u8 = INST | INIT | COMPLETE | FAILED | EVENT | CONTINUOUS | TERMINATED | ERROR;

macro_rules! calls {
    ($($call:ident $name:literal $phases:expr;)+) => {
        /// A function of FMI that is legal in certain states only.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs)]
        pub enum Call { $($call),+ }

        impl Call {
            /// All calls.
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
    Terminate                "fmi2Terminate"                COMPLETE | FAILED | EVENT | CONTINUOUS;
    Reset                    "fmi2Reset"                    ALWAYS;
    GetReal                  "fmi2GetReal"                  ALWAYS; // outputs not in `instantiated`, see `values`
    GetInteger               "fmi2GetInteger"               ALWAYS;
    GetBoolean               "fmi2GetBoolean"               ALWAYS;
    GetString                "fmi2GetString"                ALWAYS;
    SetReal                  "fmi2SetReal"                  INST | INIT | COMPLETE | EVENT | CONTINUOUS; // see `values`
    SetInteger               "fmi2SetInteger"               INST | INIT | COMPLETE | EVENT;
    SetBoolean               "fmi2SetBoolean"               INST | INIT | COMPLETE | EVENT;
    SetString                "fmi2SetString"                INST | INIT | COMPLETE | EVENT;
    GetFmuState              "fmi2GetFMUstate"              ALWAYS & !ERROR; // not after an error: the state may be invalid
    SetFmuState              "fmi2SetFMUstate"              ALWAYS;
    FreeFmuState             "fmi2FreeFMUstate"             ALWAYS;
    SerializedFmuStateSize   "fmi2SerializedFMUstateSize"   ALWAYS;
    SerializeFmuState        "fmi2SerializeFMUstate"        ALWAYS;
    DeSerializeFmuState      "fmi2DeSerializeFMUstate"      ALWAYS;
    GetDirectionalDerivative "fmi2GetDirectionalDerivative" ALWAYS & !INST;
    SetRealInputDerivatives  "fmi2SetRealInputDerivatives"  INST | INIT | COMPLETE;
    GetRealOutputDerivatives "fmi2GetRealOutputDerivatives" COMPLETE | FAILED | TERMINATED | ERROR;
    DoStep                   "fmi2DoStep"                   COMPLETE;
    CancelStep               "fmi2CancelStep"               NEVER;
    GetStatus                "fmi2GetStatus"                COMPLETE | FAILED | TERMINATED;
    GetRealStatus            "fmi2GetRealStatus"            COMPLETE | FAILED | TERMINATED;
    GetIntegerStatus         "fmi2GetIntegerStatus"         COMPLETE | FAILED | TERMINATED;
    GetBooleanStatus         "fmi2GetBooleanStatus"         COMPLETE | FAILED | TERMINATED;
    GetStringStatus          "fmi2GetStringStatus"          COMPLETE | FAILED | TERMINATED;
    EnterEventMode           "fmi2EnterEventMode"           EVENT | CONTINUOUS;
    NewDiscreteStates        "fmi2NewDiscreteStates"        EVENT;
    EnterContinuousTimeMode  "fmi2EnterContinuousTimeMode"  EVENT;
    CompletedIntegratorStep  "fmi2CompletedIntegratorStep"  CONTINUOUS;
    SetTime                  "fmi2SetTime"                  EVENT | CONTINUOUS;
    SetContinuousStates      "fmi2SetContinuousStates"      CONTINUOUS;
    GetDerivatives           "fmi2GetDerivatives"           INIT | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetEventIndicators       "fmi2GetEventIndicators"       INIT | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetContinuousStates      "fmi2GetContinuousStates"      INIT | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetNominals              "fmi2GetNominalsOfContinuousStates" ALWAYS;
}

impl Call {
    /// Whether the call is legal in `phase`.
    pub fn legal(self, phase: Phase) -> bool {
        self.phases() & (1 << phase as u8) != 0
    }

    /// Refuses a call that is not legal in `phase`.
    pub fn check(self, phase: Phase) -> CallResult {
        if self.legal(phase) {
            return Ok(());
        }
        let legal: Vec<_> = Phase::ALL.into_iter().filter(|&p| self.legal(p)).map(Phase::name).collect();
        let states =
            if legal.is_empty() { "no state of this FMU".into() } else { format!("\"{}\"", legal.join("\", \"")) };
        Err(CallError::error(format!("not legal in the state \"{}\"; legal in {states}", phase.name())))
    }
}

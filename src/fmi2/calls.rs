//! Which call is legal in which state: the co-simulation table of FMI 2.0.4, section 4.2.4.

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
}

impl Phase {
    const ALL: [Self; 6] = {
        use Phase::*;
        [Instantiated, Initialization, StepComplete, StepFailed, Terminated, Error]
    };

    /// Name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initialization mode",
            Self::StepComplete => "step complete",
            Self::StepFailed => "step failed",
            Self::Terminated => "terminated",
            Self::Error => "error",
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
const ALWAYS: u8 = INST | INIT | DONE | FAILED | END | ERROR;

macro_rules! calls {
    ($($call:ident $name:literal $phases:expr;)+) => {
        /// A call that is legal in some states only.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs)]
        pub enum Call { $($call),+ }

        impl Call {
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
    Terminate                "fmi2Terminate"                DONE | FAILED;
    Reset                    "fmi2Reset"                    ALWAYS;
    GetReal                  "fmi2GetReal"                  ALWAYS; // outputs not in `instantiated`, see `values`
    GetInteger               "fmi2GetInteger"               ALWAYS;
    GetBoolean               "fmi2GetBoolean"               ALWAYS;
    GetString                "fmi2GetString"                ALWAYS;
    SetReal                  "fmi2SetReal"                  INST | INIT | DONE;
    SetInteger               "fmi2SetInteger"               INST | INIT | DONE;
    SetBoolean               "fmi2SetBoolean"               INST | INIT | DONE;
    SetString                "fmi2SetString"                INST | INIT | DONE;
    GetFmuState              "fmi2GetFMUstate"              ALWAYS & !ERROR; // an erroneous state is not worth keeping
    SetFmuState              "fmi2SetFMUstate"              ALWAYS;
    FreeFmuState             "fmi2FreeFMUstate"             ALWAYS;
    SerializedFmuStateSize   "fmi2SerializedFMUstateSize"   ALWAYS;
    SerializeFmuState        "fmi2SerializeFMUstate"        ALWAYS;
    DeSerializeFmuState      "fmi2DeSerializeFMUstate"      ALWAYS;
    GetDirectionalDerivative "fmi2GetDirectionalDerivative" INIT | DONE | FAILED | END | ERROR;
    SetRealInputDerivatives  "fmi2SetRealInputDerivatives"  INST | INIT | DONE;
    GetRealOutputDerivatives "fmi2GetRealOutputDerivatives" DONE | FAILED | END | ERROR;
    DoStep                   "fmi2DoStep"                   DONE;
    CancelStep               "fmi2CancelStep"               NEVER;
    GetStatus                "fmi2GetStatus"                DONE | FAILED | END;
    GetRealStatus            "fmi2GetRealStatus"            DONE | FAILED | END;
    GetIntegerStatus         "fmi2GetIntegerStatus"         DONE | FAILED | END;
    GetBooleanStatus         "fmi2GetBooleanStatus"         DONE | FAILED | END;
    GetStringStatus          "fmi2GetStringStatus"          DONE | FAILED | END;
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

//! Table of calls on an instance, with the states in which they are legal: FMI 2.0.4, sections 3.2.3 (model exchange)
//! and 4.2.4 (co-simulation). Functions without a row are always legal: they return the versions, or create or free an
//! instance.

use crate::instance::{Interface, Phase, calls};

/// FMI 2.0.
pub static INTERFACE: Interface = Interface {
    version: 2,
    setup: "fmi2SetupExperiment",
    set_state: "fmi2SetFMUstate",
    reset: "fmi2Reset",
    exit_initialization: "fmi2ExitInitializationMode",
};

const INSTANTIATED: u16 = Phase::Instantiated.bit();
const INITIALIZATION: u16 = Phase::Initialization.bit();
const COMPLETE: u16 = Phase::StepComplete.bit();
const FAILED: u16 = Phase::StepFailed.bit();
const TERMINATED: u16 = Phase::Terminated.bit();
const ERROR: u16 = Phase::Error.bit();
/// No state: fmi2CancelStep is never legal, because steps are synchronous.
const NEVER: u16 = 0;
const EVENT: u16 = Phase::Event.bit();
const CONTINUOUS: u16 = Phase::ContinuousTime.bit();
/// States in which a real variable may be set. `instance::values` refuses most variables in some of them.
const CAN_SET_REAL: u16 = INSTANTIATED | INITIALIZATION | COMPLETE | EVENT | CONTINUOUS;
const ALWAYS: u16 = INSTANTIATED | INITIALIZATION | COMPLETE | FAILED | EVENT | CONTINUOUS | TERMINATED | ERROR;

calls! {
    &INTERFACE;
    SetDebugLogging          "fmi2SetDebugLogging"          ALWAYS;
    SetupExperiment          "fmi2SetupExperiment"          INSTANTIATED;
    EnterInitializationMode  "fmi2EnterInitializationMode"  INSTANTIATED;
    ExitInitializationMode   "fmi2ExitInitializationMode"   INITIALIZATION;
    Terminate                "fmi2Terminate"                COMPLETE | FAILED | EVENT | CONTINUOUS;
    Reset                    "fmi2Reset"                    ALWAYS;
    GetReal                  "fmi2GetReal"                  ALWAYS; // outputs only from initialization mode on
    GetInteger               "fmi2GetInteger"               ALWAYS;
    GetBoolean               "fmi2GetBoolean"               ALWAYS;
    GetString                "fmi2GetString"                ALWAYS;
    SetReal                  "fmi2SetReal"                  CAN_SET_REAL;
    SetInteger               "fmi2SetInteger"               INSTANTIATED | INITIALIZATION | COMPLETE | EVENT;
    SetBoolean               "fmi2SetBoolean"               INSTANTIATED | INITIALIZATION | COMPLETE | EVENT;
    SetString                "fmi2SetString"                INSTANTIATED | INITIALIZATION | COMPLETE | EVENT;
    GetFmuState              "fmi2GetFMUstate"              ALWAYS & !ERROR; // after an error, the state may be invalid
    SetFmuState              "fmi2SetFMUstate"              ALWAYS;
    FreeFmuState             "fmi2FreeFMUstate"             ALWAYS;
    SerializedFmuStateSize   "fmi2SerializedFMUstateSize"   ALWAYS;
    SerializeFmuState        "fmi2SerializeFMUstate"        ALWAYS;
    DeSerializeFmuState      "fmi2DeSerializeFMUstate"      ALWAYS;
    GetDirectionalDerivative "fmi2GetDirectionalDerivative" ALWAYS & !INSTANTIATED;
    SetRealInputDerivatives  "fmi2SetRealInputDerivatives"  INSTANTIATED | INITIALIZATION | COMPLETE;
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
    GetDerivatives           "fmi2GetDerivatives"           INITIALIZATION | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetEventIndicators       "fmi2GetEventIndicators"       INITIALIZATION | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetContinuousStates      "fmi2GetContinuousStates"      INITIALIZATION | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetNominals              "fmi2GetNominalsOfContinuousStates" ALWAYS;
}

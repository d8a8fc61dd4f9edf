//! Table of calls and the states in which they are legal: FMI 3.0.2, sections 3.2 (model exchange) and 4.2
//! (co-simulation).

use crate::instance::{Interface, Phase, calls};

/// FMI 3.0.
pub static INTERFACE: Interface = Interface {
    version: 3,
    setup: "fmi3EnterInitializationMode",
    set_state: "fmi3SetFMUState",
    reset: "fmi3Reset",
    exit_initialization: "fmi3ExitInitializationMode",
};

const INST: u16 = Phase::Instantiated.bit();
const CONF: u16 = Phase::Configuration.bit();
const INIT: u16 = Phase::Initialization.bit();
const STEP: u16 = Phase::StepComplete.bit();
const INTER: u16 = Phase::IntermediateUpdate.bit();
const FAILED: u16 = Phase::StepFailed.bit();
const EVENT: u16 = Phase::Event.bit();
const CONTINUOUS: u16 = Phase::ContinuousTime.bit();
const TERMINATED: u16 = Phase::Terminated.bit();
const ERROR: u16 = Phase::Error.bit();
const ALWAYS: u16 = INST | CONF | INIT | STEP | INTER | FAILED | EVENT | CONTINUOUS | TERMINATED | ERROR;
/// States in which a variable may be set.
const SET: u16 = INST | CONF | INIT | STEP | EVENT;
/// States in which derivatives have values.
const LOOK: u16 = INIT | STEP | INTER | EVENT | CONTINUOUS | TERMINATED | ERROR;

calls! {
    &INTERFACE;
    SetDebugLogging             "fmi3SetDebugLogging"             ALWAYS;
    EnterInitializationMode     "fmi3EnterInitializationMode"     INST;
    ExitInitializationMode      "fmi3ExitInitializationMode"      INIT;
    EnterConfigurationMode      "fmi3EnterConfigurationMode"      INST;
    ExitConfigurationMode       "fmi3ExitConfigurationMode"       CONF;
    EnterEventMode              "fmi3EnterEventMode"              STEP | EVENT | CONTINUOUS;
    Terminate                   "fmi3Terminate"                   STEP | FAILED | EVENT | CONTINUOUS;
    Reset                       "fmi3Reset"                       ALWAYS;
    GetFloat64                  "fmi3GetFloat64"                  ALWAYS; // outputs not in `instantiated`, see `instance::values`
    GetInt32                    "fmi3GetInt32"                    ALWAYS;
    GetInt64                    "fmi3GetInt64"                    ALWAYS;
    GetUInt64                   "fmi3GetUInt64"                   ALWAYS;
    GetBoolean                  "fmi3GetBoolean"                  ALWAYS;
    GetString                   "fmi3GetString"                   ALWAYS;
    GetOther                    "fmi3Get of a type without variables" ALWAYS;
    SetFloat64                  "fmi3SetFloat64"                  SET | INTER | CONTINUOUS;
    SetInt32                    "fmi3SetInt32"                    SET;
    SetInt64                    "fmi3SetInt64"                    SET;
    SetUInt64                   "fmi3SetUInt64"                   SET;
    SetBoolean                  "fmi3SetBoolean"                  SET;
    SetString                   "fmi3SetString"                   SET;
    SetOther                    "fmi3Set of a type without variables" SET;
    GetVariableDependencies     "fmi3GetVariableDependencies"     ALWAYS;
    GetFmuState                 "fmi3GetFMUState"                 ALWAYS & !ERROR & !INTER;
    SetFmuState                 "fmi3SetFMUState"                 ALWAYS & !INTER;
    FreeFmuState                "fmi3FreeFMUState"                ALWAYS;
    SerializedFmuStateSize      "fmi3SerializedFMUStateSize"      ALWAYS;
    SerializeFmuState           "fmi3SerializeFMUState"           ALWAYS;
    DeserializeFmuState         "fmi3DeserializeFMUState"         ALWAYS;
    GetDirectionalDerivative    "fmi3GetDirectionalDerivative"    LOOK;
    GetAdjointDerivative        "fmi3GetAdjointDerivative"        LOOK;
    Clocks                      "functions of clocks"             ALWAYS;
    EvaluateDiscreteStates      "fmi3EvaluateDiscreteStates"      INIT | EVENT;
    UpdateDiscreteStates        "fmi3UpdateDiscreteStates"        EVENT;
    EnterContinuousTimeMode     "fmi3EnterContinuousTimeMode"     EVENT;
    CompletedIntegratorStep     "fmi3CompletedIntegratorStep"     CONTINUOUS;
    SetTime                     "fmi3SetTime"                     EVENT | CONTINUOUS;
    SetContinuousStates         "fmi3SetContinuousStates"         CONTINUOUS;
    GetContinuousStateDerivatives "fmi3GetContinuousStateDerivatives" INIT | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetEventIndicators          "fmi3GetEventIndicators"          INIT | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetContinuousStates         "fmi3GetContinuousStates"         INIT | EVENT | CONTINUOUS | TERMINATED | ERROR;
    GetNominals                 "fmi3GetNominalsOfContinuousStates" ALWAYS;
    GetNumberOfEventIndicators  "fmi3GetNumberOfEventIndicators"  ALWAYS;
    GetNumberOfContinuousStates "fmi3GetNumberOfContinuousStates" ALWAYS;
    EnterStepMode               "fmi3EnterStepMode"               EVENT;
    GetOutputDerivatives        "fmi3GetOutputDerivatives"        STEP | INTER | FAILED | TERMINATED | ERROR;
    DoStep                      "fmi3DoStep"                      STEP;
    EndIntermediateUpdate       "fmi3DoStep"                      INTER;
    ActivateModelPartition      "fmi3ActivateModelPartition"      0;
}

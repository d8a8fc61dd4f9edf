//! Table of calls on an instance, with the states in which they are legal: FMI 3.0.2, sections 3.2 (model exchange) and
//! 4.2 (co-simulation). Several functions may share a row. Functions without a row are always legal: they return the
//! version, or create or free an instance.

use crate::instance::{Interface, Phase, calls};

/// FMI 3.0.
pub static INTERFACE: Interface = Interface {
    version: 3,
    setup: "fmi3EnterInitializationMode",
    set_state: "fmi3SetFMUState",
    reset: "fmi3Reset",
    exit_initialization: "fmi3ExitInitializationMode",
};

const INSTANTIATED: u16 = Phase::Instantiated.bit();
const CONFIGURATION: u16 = Phase::Configuration.bit();
const INITIALIZATION: u16 = Phase::Initialization.bit();
const STEP: u16 = Phase::StepComplete.bit();
const INTERMEDIATE: u16 = Phase::IntermediateUpdate.bit();
const FAILED: u16 = Phase::StepFailed.bit();
const EVENT: u16 = Phase::Event.bit();
const CONTINUOUS: u16 = Phase::ContinuousTime.bit();
const TERMINATED: u16 = Phase::Terminated.bit();
const ERROR: u16 = Phase::Error.bit();
const ALWAYS: u16 = INSTANTIATED
    | CONFIGURATION
    | INITIALIZATION
    | STEP
    | INTERMEDIATE
    | FAILED
    | EVENT
    | CONTINUOUS
    | TERMINATED
    | ERROR;
/// States in which a variable may be set.
const CAN_SET: u16 = INSTANTIATED | CONFIGURATION | INITIALIZATION | STEP | EVENT;
/// States in which directional and adjoint derivatives have values.
const HAS_DERIVATIVES: u16 = INITIALIZATION | STEP | INTERMEDIATE | EVENT | CONTINUOUS | TERMINATED | ERROR;
/// States in which the continuous states, their derivatives and the event indicators have values.
const HAS_STATES: u16 = INITIALIZATION | EVENT | CONTINUOUS | TERMINATED | ERROR;

calls! {
    &INTERFACE;
    SetDebugLogging             "fmi3SetDebugLogging"             ALWAYS;
    EnterInitializationMode     "fmi3EnterInitializationMode"     INSTANTIATED;
    ExitInitializationMode      "fmi3ExitInitializationMode"      INITIALIZATION;
    EnterConfigurationMode      "fmi3EnterConfigurationMode"      INSTANTIATED;
    ExitConfigurationMode       "fmi3ExitConfigurationMode"       CONFIGURATION;
    EnterEventMode              "fmi3EnterEventMode"              STEP | EVENT | CONTINUOUS;
    Terminate                   "fmi3Terminate"                   STEP | FAILED | EVENT | CONTINUOUS;
    Reset                       "fmi3Reset"                       ALWAYS;
    GetFloat64                  "fmi3GetFloat64"                  ALWAYS; // outputs only from initialization mode on
    GetInt32                    "fmi3GetInt32"                    ALWAYS;
    GetInt64                    "fmi3GetInt64"                    ALWAYS;
    GetUInt64                   "fmi3GetUInt64"                   ALWAYS;
    GetBoolean                  "fmi3GetBoolean"                  ALWAYS;
    GetString                   "fmi3GetString"                   ALWAYS;
    GetOther                    "fmi3Get of a type without variables" ALWAYS;
    SetFloat64                  "fmi3SetFloat64"                  CAN_SET | INTERMEDIATE | CONTINUOUS;
    SetInt32                    "fmi3SetInt32"                    CAN_SET;
    SetInt64                    "fmi3SetInt64"                    CAN_SET;
    SetUInt64                   "fmi3SetUInt64"                   CAN_SET;
    SetBoolean                  "fmi3SetBoolean"                  CAN_SET;
    SetString                   "fmi3SetString"                   CAN_SET;
    SetOther                    "fmi3Set of a type without variables" CAN_SET;
    GetVariableDependencies     "fmi3GetVariableDependencies"     ALWAYS;
    GetFmuState                 "fmi3GetFMUState"                 ALWAYS & !ERROR & !INTERMEDIATE;
    SetFmuState                 "fmi3SetFMUState"                 ALWAYS & !INTERMEDIATE;
    FreeFmuState                "fmi3FreeFMUState"                ALWAYS;
    SerializedFmuStateSize      "fmi3SerializedFMUStateSize"      ALWAYS;
    SerializeFmuState           "fmi3SerializeFMUState"           ALWAYS;
    DeserializeFmuState         "fmi3DeserializeFMUState"         ALWAYS;
    GetDirectionalDerivative    "fmi3GetDirectionalDerivative"    HAS_DERIVATIVES;
    GetAdjointDerivative        "fmi3GetAdjointDerivative"        HAS_DERIVATIVES;
    Clocks                      "functions of clocks"             ALWAYS;
    EvaluateDiscreteStates      "fmi3EvaluateDiscreteStates"      INITIALIZATION | EVENT;
    UpdateDiscreteStates        "fmi3UpdateDiscreteStates"        EVENT;
    EnterContinuousTimeMode     "fmi3EnterContinuousTimeMode"     EVENT;
    CompletedIntegratorStep     "fmi3CompletedIntegratorStep"     CONTINUOUS;
    SetTime                     "fmi3SetTime"                     EVENT | CONTINUOUS;
    SetContinuousStates         "fmi3SetContinuousStates"         CONTINUOUS;
    GetContinuousStateDerivatives "fmi3GetContinuousStateDerivatives" HAS_STATES;
    GetEventIndicators          "fmi3GetEventIndicators"          HAS_STATES;
    GetContinuousStates         "fmi3GetContinuousStates"         HAS_STATES;
    GetNominals                 "fmi3GetNominalsOfContinuousStates" ALWAYS;
    GetNumberOfEventIndicators  "fmi3GetNumberOfEventIndicators"  ALWAYS;
    GetNumberOfContinuousStates "fmi3GetNumberOfContinuousStates" ALWAYS;
    EnterStepMode               "fmi3EnterStepMode"               EVENT;
    GetOutputDerivatives        "fmi3GetOutputDerivatives"        STEP | INTERMEDIATE | FAILED | TERMINATED | ERROR;
    DoStep                      "fmi3DoStep"                      STEP;
    EndIntermediateUpdate       "fmi3DoStep"                      INTERMEDIATE;
    ActivateModelPartition      "fmi3ActivateModelPartition"      0;
}

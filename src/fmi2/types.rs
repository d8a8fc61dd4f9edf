//! Types of the FMI 2.0 headers, platform "default".

use crate::fmi2::c_types::{c_char, c_int, c_uint, c_void};

use serde::{Deserialize, Serialize};

/// fmi2Boolean: 0 is false.
pub type Boolean = c_int;
/// fmi2Component: pointer to an instance.
pub type ComponentPointer = *mut c_void;
/// fmi2FMUstate: pointer to a snapshot.
pub type FmuState = *mut c_void;
/// fmi2String.
pub type Text = *const c_char;
/// fmi2ValueReference.
pub type ValueReference = c_uint;

/// fmi2Status.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Success.
    Ok = 0,
    /// Not quite right, but the simulation continues.
    Warning = 1,
    /// Refused or carried out in part; the instance is valid.
    Discard = 2,
    /// Refused, or failed; see the log.
    Error = 3,
    /// The instance is unusable; never returned by this FMU.
    Fatal = 4,
    /// The step still runs; never returned by this FMU.
    Pending = 5,
}

/// fmi2Type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum Kind {
    /// The host has the solver.
    ModelExchange = 0,
    /// The instance has the solver.
    CoSimulation = 1,
}

/// fmi2ModelExchange of fmi2Type.
pub const MODEL_EXCHANGE: c_int = Kind::ModelExchange as c_int;
/// fmi2CoSimulation of fmi2Type.
pub const CO_SIMULATION: c_int = Kind::CoSimulation as c_int;

/// fmi2DoStepStatus of fmi2StatusKind.
pub const DO_STEP_STATUS: c_int = 0;
/// fmi2PendingStatus of fmi2StatusKind.
pub const PENDING_STATUS: c_int = 1;
/// fmi2LastSuccessfulTime of fmi2StatusKind.
pub const LAST_SUCCESSFUL_TIME: c_int = 2;
/// fmi2Terminated of fmi2StatusKind.
pub const TERMINATED: c_int = 3;

/// fmi2CallbackLogger; variadic as printf.
pub type Logger =
    unsafe extern "C" fn(env: *mut c_void, instance: Text, status: Status, category: Text, message: Text, ...);

/// fmi2EventInfo.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EventInfo {
    /// Whether fmi2NewDiscreteStates must be called again.
    pub new_discrete_states_needed: Boolean,
    /// Whether the simulation must end.
    pub terminate_simulation: Boolean,
    /// Whether nominal values of states changed.
    pub nominals_changed: Boolean,
    /// Whether states changed.
    pub states_changed: Boolean,
    /// Whether the next event is known.
    pub next_event_defined: Boolean,
    /// Its time [s].
    pub next_event: f64,
}

/// fmi2CallbackFunctions. Only the logger is used; the library allocates its memory itself.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CallbackFunctions {
    /// Receives messages; may be NULL.
    pub logger: Option<Logger>,
    /// Unused.
    pub allocate_memory: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    /// Unused.
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    /// Unused: steps are synchronous.
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, Status)>,
    /// Passed to the logger unchanged.
    pub component_environment: *mut c_void,
}

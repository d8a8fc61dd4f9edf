//! Types of the FMI 2.0 headers, platform "default".

use crate::instance::c_types::{c_int, c_void};
pub use crate::instance::{ComponentPointer, FmuState, Kind, Status, Text, ValueReference};

/// fmi2Boolean: 0 is false.
pub type Boolean = c_int;
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

/// fmi2CallbackLogger, variadic like printf.
pub type Logger =
    unsafe extern "C" fn(env: *mut c_void, instance: Text, status: Status, category: Text, message: Text, ...);

/// fmi2EventInfo.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EventInfo {
    /// True if fmi2NewDiscreteStates must be called again.
    pub new_discrete_states_needed: Boolean,
    /// True if the simulation must end.
    pub terminate_simulation: Boolean,
    /// True if nominal values of states changed.
    pub nominals_changed: Boolean,
    /// True if states changed.
    pub states_changed: Boolean,
    /// True if the time of the next event is known.
    pub next_event_defined: Boolean,
    /// Time of the next event [s].
    pub next_event: f64,
}

/// fmi2CallbackFunctions. Only the logger is used, because the library allocates its own memory.
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

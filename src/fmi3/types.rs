//! Types of the FMI 3.0 headers.

use crate::instance::c_types::{c_int, c_void};
pub use crate::instance::{ComponentPointer, FmuState, Kind, Status, Text, ValueReference};

/// fmi3Boolean: a C `bool`, read as a byte so that any value of a host is valid.
pub type Boolean = u8;

/// fmi3LogMessageCallback.
pub type LogMessage = unsafe extern "C" fn(environment: *mut c_void, status: Status, category: Text, message: Text);

/// fmi3IntermediateUpdateCallback.
pub type IntermediateUpdate = unsafe extern "C" fn(
    environment: *mut c_void,
    time: f64,
    set_requested: Boolean,
    get_allowed: Boolean,
    step_finished: Boolean,
    can_return_early: Boolean,
    early_return_requested: *mut Boolean,
    early_return_time: *mut f64,
);

/// fmi3DependencyKind.
pub type DependencyKind = c_int;

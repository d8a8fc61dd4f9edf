//! Start of an instance.

use std::ffi::{c_int, c_void};
use std::ptr;

use bevel_differential::fmi2::{Boolean, CallbackFunctions, ComponentPointer, Logger, Status, Text, fmi2Instantiate};

use crate::{messages, reason, room};

/// A logger in C has any number of arguments. Compiled for WebAssembly, they are one pointer, which is not used.
type PlainLogger = unsafe extern "C" fn(*mut c_void, Text, Status, Text, Text, *const c_void);

unsafe extern "C" fn keep(_: *mut c_void, _: Text, status: Status, category: Text, message: Text, _: *const c_void) {
    // SAFETY: the library passes texts that end with 0
    unsafe { messages::keep(status, category, message) };
}

/// Allocates room and sets the panic hook. It must be the first call.
#[unsafe(no_mangle)]
pub extern "C" fn source_start() {
    reason::keep();
    room::make();
    messages::make();
}

/// Calls fmi2Instantiate with a logger that stores messages.
///
/// # Safety
/// `name` and `guid` are NULL or end with 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn source_instantiate(name: Text, kind: c_int, guid: Text, logging: Boolean) -> ComponentPointer {
    // SAFETY: the same function type for WebAssembly, see `PlainLogger`
    let logger = unsafe { std::mem::transmute::<PlainLogger, Logger>(keep) };
    let callbacks = CallbackFunctions {
        logger: Some(logger),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: ptr::null_mut(),
    };
    // SAFETY: guaranteed by the caller; the callbacks are copied
    unsafe { fmi2Instantiate(name, kind, guid, ptr::null(), &callbacks, 0, logging) }
}

//! An instance of FMI 3.0.

use std::ffi::c_void;
use std::ptr;

use bevel_differential::fmi3::{Boolean, ComponentPointer, Status, Text, fmi3InstantiateCoSimulation};

use crate::messages;

unsafe extern "C" fn keep(_: *mut c_void, status: Status, category: Text, message: Text) {
    // SAFETY: the library passes texts that end with 0
    unsafe { messages::keep(status, category, message) };
}

/// fmi3InstantiateCoSimulation with messages that are kept, and without a function to call within steps.
///
/// # Safety
/// `name` and `token` are NULL or end with 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn source_instantiate(
    name: Text,
    token: Text,
    logging: Boolean,
    event_mode_used: Boolean,
    early_return_allowed: Boolean,
) -> ComponentPointer {
    // SAFETY: the caller's promise
    unsafe {
        fmi3InstantiateCoSimulation(
            name,
            token,
            ptr::null(),
            0,
            logging,
            event_mode_used,
            early_return_allowed,
            ptr::null(),
            0,
            ptr::null_mut(),
            Some(keep),
            None,
        )
    }
}

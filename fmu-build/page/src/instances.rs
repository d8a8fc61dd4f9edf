//! Instances that store their messages for the page.

use std::ffi::CStr;
use std::sync::Mutex;

use bevel_differential::fmi2::{
    CO_SIMULATION, CallbackFunctions, ComponentPointer, Logger, Status, Text, fmi2Instantiate,
};
use bevel_differential::variables::guid;

/// Messages since the last reading, one line each: the status of FMI, a blank, the text.
static MESSAGES: Mutex<String> = Mutex::new(String::new());

/// A logger in C has any number of arguments. Compiled for WebAssembly, they are one pointer, which is not used.
type PlainLogger = unsafe extern "C" fn(*mut core::ffi::c_void, Text, Status, Text, Text, *const core::ffi::c_void);

unsafe extern "C" fn keep(
    _: *mut core::ffi::c_void,
    _: Text,
    status: Status,
    _: Text,
    message: Text,
    _: *const core::ffi::c_void,
) {
    // SAFETY: the library passes texts that end with 0
    let text = unsafe { CStr::from_ptr(message) }.to_string_lossy().replace('\n', " ");
    if let Ok(mut messages) = MESSAGES.lock() {
        messages.push_str(&format!("{} {text}\n", status as i32));
    }
}

/// Creates an instance for co-simulation, to be used with the functions of FMI.
#[unsafe(no_mangle)]
pub extern "C" fn page_instantiate() -> ComponentPointer {
    // SAFETY: the same function type for WebAssembly, see `PlainLogger`
    let logger = unsafe { std::mem::transmute::<PlainLogger, Logger>(keep) };
    let callbacks = Box::leak(Box::new(CallbackFunctions {
        logger: Some(logger),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: std::ptr::null_mut(),
    }));
    let guid = std::ffi::CString::new(guid()).unwrap_or_default();
    // SAFETY: texts that end with 0, and callbacks that are never freed
    unsafe { fmi2Instantiate(c"page".as_ptr(), CO_SIMULATION, guid.as_ptr(), std::ptr::null(), callbacks, 0, 0) }
}

/// Moves all messages, in UTF-8, to `place`, and returns their length. Longer messages are cut to `room` bytes.
///
/// # Safety
/// `place` has room for `room` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_messages(place: *mut u8, room: usize) -> usize {
    let text = MESSAGES.lock().map(|mut messages| std::mem::take(&mut *messages)).unwrap_or_default();
    let length = text.len().min(room);
    // SAFETY: guaranteed by the caller
    unsafe { std::ptr::copy_nonoverlapping(text.as_ptr(), place, length) };
    length
}

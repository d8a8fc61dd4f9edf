//! A logger that records its lines. It is also used by the unit tests of `src/fmi2` and by the random calls of
//! `fmu-build`.
#![allow(dead_code)] // each program uses only some items

use std::ffi::{CStr, c_void};
use std::ptr;
use std::sync::{Mutex, MutexGuard, PoisonError};

use bevel_differential::fmi2::{CallbackFunctions, Logger, Status, Text};

/// A logger without variable arguments.
pub type PlainLogger = unsafe extern "C" fn(*mut c_void, Text, Status, Text, Text);

/// A line of the log.
#[derive(Clone, Debug)]
pub struct Line {
    pub status: Status,
    pub category: String,
    pub message: String,
}

/// Lines logged so far.
#[derive(Default)]
pub struct Recorder(Mutex<Vec<Line>>);

impl Recorder {
    /// Returns callbacks that record into this recorder, which must outlive the instance.
    pub fn callbacks(&self) -> CallbackFunctions {
        callbacks(record, ptr::from_ref(self).cast_mut().cast())
    }

    /// Access to the lines.
    pub fn lines(&self) -> MutexGuard<'_, Vec<Line>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns callbacks with `logger`.
pub fn callbacks(logger: PlainLogger, environment: *mut c_void) -> CallbackFunctions {
    // SAFETY: on the platforms of the tests, a plain function receives fixed arguments like a variadic function
    let logger = unsafe { std::mem::transmute::<PlainLogger, Logger>(logger) };
    CallbackFunctions {
        logger: Some(logger),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: environment,
    }
}

/// Records a message. The logger is variadic in C, but no argument follows the message.
unsafe extern "C" fn record(environment: *mut c_void, _instance: Text, status: Status, category: Text, message: Text) {
    // SAFETY: `environment` is the recorder, which outlives the instance; the strings come from the FMU
    let (recorder, category, message) =
        unsafe { (&*environment.cast::<Recorder>(), CStr::from_ptr(category), CStr::from_ptr(message)) };
    assert!(!message.to_bytes().contains(&b'%'), "a printf format must contain no conversion: {message:?}");
    let (category, message) = (category.to_string_lossy().into_owned(), message.to_string_lossy().into_owned());
    recorder.lines().push(Line { status, category, message });
}

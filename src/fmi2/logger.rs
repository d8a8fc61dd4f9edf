//! The host's logger of FMI 2.0, a variadic function like printf.

use std::ffi::CString;

use super::types::{CallbackFunctions, Logger};
use crate::instance::c_types::c_void;
use crate::instance::{Category, Sink, Status};

/// The host's logger, with the arguments of every message.
pub struct HostLogger {
    logger: Logger,
    environment: *mut c_void,
    instance: CString,
}

// SAFETY: the host must keep its logger and the environment valid on every thread from which it calls the instance;
// only one call at a time uses the log
unsafe impl Send for HostLogger {}

impl HostLogger {
    /// Returns the logger of `callbacks`, if there is one, for the instance of this name.
    pub fn of(callbacks: Option<CallbackFunctions>, instance: CString) -> Option<Box<dyn Sink>> {
        let callbacks = callbacks?;
        let logger = Self { logger: callbacks.logger?, environment: callbacks.component_environment, instance };
        Some(Box::new(logger))
    }
}

impl Sink for HostLogger {
    fn send(&self, status: Status, category: Category, message: &str) {
        let text = printable(message);
        // SAFETY: the logger is valid by the host's promise; the strings outlive the call; the logger uses the message
        // as a printf format, which has no conversions and needs no further arguments
        unsafe {
            (self.logger)(self.environment, self.instance.as_ptr(), status, category.name().as_ptr(), text.as_ptr());
        }
    }
}

/// Returns `message` as a valid printf format without conversions.
fn printable(message: &str) -> CString {
    let text = message.replace('%', " percent").replace('\0', " ");
    CString::new(text).unwrap_or_default()
}

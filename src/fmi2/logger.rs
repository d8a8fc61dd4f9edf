//! The host's logger of FMI 2.0: a variadic function in the manner of printf.

use std::ffi::CString;

use super::types::{CallbackFunctions, Logger};
use crate::instance::c_types::c_void;
use crate::instance::{Category, Sink, Status};

/// The logger, and what it is given with every message.
pub struct HostLogger {
    logger: Logger,
    environment: *mut c_void,
    instance: CString,
}

// SAFETY: this holds the host's logger and its environment, which the host must keep valid on every thread from which it calls
// the instance; the log itself is used by one call at a time
unsafe impl Send for HostLogger {}

impl HostLogger {
    /// The logger among `callbacks` under the name `instance`, if there is one.
    pub fn of(callbacks: Option<CallbackFunctions>, instance: CString) -> Option<Box<dyn Sink>> {
        let callbacks = callbacks?;
        let logger = Self { logger: callbacks.logger?, environment: callbacks.component_environment, instance };
        Some(Box::new(logger))
    }
}

impl Sink for HostLogger {
    fn send(&self, status: Status, category: Category, message: &str) {
        let text = printable(message);
        // SAFETY: the logger is valid by the host's promise; the strings outlive the call; the message, which the logger uses as a
        // printf format, contains no conversion and so requires no further argument
        unsafe {
            (self.logger)(self.environment, self.instance.as_ptr(), status, category.name().as_ptr(), text.as_ptr());
        }
    }
}

/// `message` as a valid printf format without conversions.
fn printable(message: &str) -> CString {
    let text = message.replace('%', " percent").replace('\0', " ");
    CString::new(text).unwrap_or_default()
}

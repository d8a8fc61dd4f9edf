//! The host's logger of FMI 3.0.

use std::ffi::CString;

use super::types::LogMessage;
use crate::instance::c_types::c_void;
use crate::instance::{Category, Sink, Status};

/// The logger, and the pointer that goes with every message.
pub struct HostLogger {
    /// The host's function.
    pub message: LogMessage,
    /// The host's pointer, passed to that function unchanged.
    pub environment: *mut c_void,
}

// SAFETY: this holds the host's logger and its environment, which the host must keep valid on every thread from which it calls
// the instance; the log itself is used by one call at a time
unsafe impl Send for HostLogger {}

impl Sink for HostLogger {
    fn send(&self, status: Status, category: Category, message: &str) {
        let text = CString::new(message.replace('\0', " ")).unwrap_or_default();
        // SAFETY: the logger is valid by the host's promise; the strings outlive the call
        unsafe { (self.message)(self.environment, status, category.name().as_ptr(), text.as_ptr()) }
    }
}

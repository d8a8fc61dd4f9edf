//! The host's logger of FMI 3.0.

use std::ffi::CString;

use super::types::LogMessage;
use crate::instance::c_types::c_void;
use crate::instance::{Category, Sink, Status};

/// The host's logger, with the pointer that it receives with every message.
pub struct HostLogger {
    /// The host's function.
    pub message: LogMessage,
    /// The host's pointer, passed to the function unchanged.
    pub environment: *mut c_void,
}

// SAFETY: the host must keep its logger and the environment valid on every thread from which it calls the instance;
// only one call at a time uses the log
unsafe impl Send for HostLogger {}

impl Sink for HostLogger {
    fn send(&self, status: Status, category: Category, message: &str) {
        let text = CString::new(message.replace('\0', " ")).unwrap_or_default();
        // SAFETY: the logger is valid by the host's promise; the strings outlive the call
        unsafe { (self.message)(self.environment, status, category.name().as_ptr(), text.as_ptr()) }
    }
}

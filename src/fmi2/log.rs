//! Messages to the host, by category, through its callback: the only way this library speaks.

use std::ffi::{CStr, CString};
use std::ptr;

use libc::c_void;

use super::types::{CallbackFunctions, Logger, Status};

/// Log category, as listed in the model description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Category {
    /// A call was refused or failed with fmi2Error.
    Error = 0,
    /// Something unusual that does not stop the simulation.
    Warning = 1,
    /// A call was refused or cut short with fmi2Discard.
    Discard = 2,
    /// What is simulated; sent only with logging on.
    Events = 3,
}

impl Category {
    /// All categories with what the model description says about them.
    pub const ALL: [(Self, &str); 4] = [
        (Self::Error, "Refused or failed calls"),
        (Self::Warning, "Unusual, but the simulation goes on"),
        (Self::Discard, "Values refused and steps cut short"),
        (Self::Events, "What is simulated"),
    ];

    /// Name at the FMI boundary.
    pub const fn name(self) -> &'static CStr {
        match self {
            Self::Error => c"logStatusError",
            Self::Warning => c"logStatusWarning",
            Self::Discard => c"logStatusDiscard",
            Self::Events => c"logEvents",
        }
    }

    fn of(status: Status) -> Self {
        match status {
            Status::Warning => Self::Warning,
            Status::Discard => Self::Discard,
            _ => Self::Error,
        }
    }
}

const ALL_CATEGORIES: u8 = 0b1111;

/// Where messages go and which of them.
pub struct Log {
    logger: Option<Logger>,
    environment: *mut c_void,
    instance: CString,
    /// Sends events too.
    verbose: bool,
    /// Categories the host wants, a bit each.
    wanted: u8,
}

impl Log {
    /// A log through `callbacks` under the name `instance`.
    pub fn new(callbacks: Option<&CallbackFunctions>, instance: CString, verbose: bool) -> Self {
        Self {
            logger: callbacks.and_then(|c| c.logger),
            environment: callbacks.map_or(ptr::null_mut(), |c| c.component_environment),
            instance,
            verbose,
            wanted: ALL_CATEGORIES,
        }
    }

    /// fmi2SetDebugLogging; returns the names that are no category. No names mean all categories.
    pub fn configure<'a>(&mut self, verbose: bool, names: impl ExactSizeIterator<Item = &'a CStr>) -> Vec<&'a CStr> {
        self.verbose = verbose;
        self.wanted = if names.len() == 0 || !verbose { ALL_CATEGORIES } else { 0 };
        let mut unknown = Vec::new();
        for name in names {
            match Category::ALL.iter().find(|(category, _)| category.name() == name) {
                Some((category, _)) => self.wanted |= 1 << *category as u8,
                None => unknown.push(name),
            }
        }
        unknown
    }

    /// An event, sent only with logging on.
    pub fn event(&self, message: &str) {
        if self.verbose {
            self.send(Status::Ok, Category::Events, message);
        }
    }

    /// Something unusual about a call that returns fmi2OK.
    pub fn warning(&self, message: &str) {
        self.send(Status::Warning, Category::Warning, message);
    }

    /// What a call that returns `status` has to say.
    pub fn status(&self, status: Status, message: &str) {
        self.send(status, Category::of(status), message);
    }

    fn send(&self, status: Status, category: Category, message: &str) {
        let Some(logger) = self.logger else { return };
        if self.wanted & (1 << category as u8) == 0 {
            return;
        }
        let text = printable(message);
        // SAFETY: the host vouched for its logger when it passed it; the strings live through the call, and the message,
        // which the logger takes for a printf format, holds no conversion and so asks for no further argument
        unsafe {
            logger(self.environment, self.instance.as_ptr(), status, category.name().as_ptr(), text.as_ptr());
        }
    }
}

/// A message that survives being a printf format: no `%`, no NUL.
fn printable(message: &str) -> CString {
    let text = message.replace('%', " percent").replace('\0', " ");
    CString::new(text).unwrap_or_default()
}

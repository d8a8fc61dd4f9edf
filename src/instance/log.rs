//! Messages to the host's logger, by category. The library has no other output.
//!
//! FMI 2.0.4, sections 2.1.3 and 2.1.5, and FMI 3.0.2, section 2.2.4: the logger receives a message for every call that
//! does not return OK. Other messages are debug logging, which the host enables and filters by category. Errors are
//! always logged.

use std::ffi::CStr;

use super::Status;

/// Log category of the model description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Category {
    /// A call returned an error. Always logged.
    Error = 0,
    /// A remark on a simulation that continues, or a call that returned a warning.
    Warning = 1,
    /// A call was discarded.
    Discard = 2,
    /// Description of the simulated scene, and statistics of the solver.
    Events = 3,
}

impl Category {
    /// All categories with their descriptions in the model description.
    pub const ALL: [(Self, &str); 4] = [
        (Self::Error, "Refused or failed calls; logged always"),
        (Self::Warning, "Unusual values; the simulation continues"),
        (Self::Discard, "Refused values and discarded steps"),
        (Self::Events, "Description of the simulated scene, and statistics of the solver"),
    ];

    /// Name in the FMI interface.
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

/// The host's logger.
pub trait Sink: Send {
    /// Passes on a message.
    fn send(&self, status: Status, category: Category, message: &str);
}

/// The host's logger, with the settings that select its messages.
pub struct Log {
    sink: Option<Box<dyn Sink>>,
    /// True if debug logging is on.
    logging_on: bool,
    /// Categories selected by the host, as a bit mask.
    categories: u8,
}

impl Log {
    /// Creates a log that writes to `sink`, if the host has a logger.
    pub fn new(sink: Option<Box<dyn Sink>>, logging_on: bool) -> Self {
        Self { sink, logging_on, categories: ALL_CATEGORIES }
    }

    /// Sets which messages are logged, and returns the names of unknown categories. An empty list of names means all
    /// categories.
    pub fn configure<'a>(&mut self, logging_on: bool, names: impl ExactSizeIterator<Item = &'a CStr>) -> Vec<&'a CStr> {
        self.logging_on = logging_on;
        self.categories = if names.len() == 0 || !logging_on { ALL_CATEGORIES } else { 0 };
        let mut unknown = Vec::new();
        for name in names {
            match Category::ALL.iter().find(|(category, _)| category.name() == name) {
                Some((category, _)) => self.categories |= 1 << *category as u8,
                None => unknown.push(name),
            }
        }
        unknown
    }

    /// True if messages of a call that returns OK are logged in `category`.
    #[inline]
    pub fn is_on(&self, category: Category) -> bool {
        self.logging_on && self.is_chosen(category)
    }

    fn is_chosen(&self, category: Category) -> bool {
        self.categories & (1 << category as u8) != 0
    }

    /// Logs an event during a call that returns OK.
    pub fn event(&self, message: &str) {
        if self.is_on(Category::Events) {
            self.send(Status::Ok, Category::Events, message);
        }
    }

    /// Logs a warning during a call that returns OK.
    pub fn warning(&self, message: &str) {
        if self.is_on(Category::Warning) {
            self.send(Status::Warning, Category::Warning, message);
        }
    }

    /// Logs the reason why a call returns `status`, which is not OK.
    pub fn status(&self, status: Status, message: &str) {
        let category = Category::of(status);
        if category == Category::Error || self.is_chosen(category) {
            self.send(status, category, message);
        }
    }

    fn send(&self, status: Status, category: Category, message: &str) {
        if let Some(sink) = &self.sink {
            sink.send(status, category, message);
        }
    }
}

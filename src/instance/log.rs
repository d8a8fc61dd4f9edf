//! Messages to the host's logger by category. The library writes nowhere else.
//!
//! FMI 2.0.4, sections 2.1.3 and 2.1.5, and FMI 3.0.2, section 2.2.4: a call that does not return OK has called the logger; other
//! messages are debug logging, which the host switches on and filters by category. Errors are logged always.

use std::ffi::CStr;

use super::Status;

/// Log category, as listed in the model description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Category {
    /// A call returned an error. Logged always.
    Error = 0,
    /// A remark on a simulation that continues, or a call that returned a warning.
    Warning = 1,
    /// A call was discarded.
    Discard = 2,
    /// What is simulated.
    Events = 3,
}

impl Category {
    /// All categories with their descriptions in the model description.
    pub const ALL: [(Self, &str); 4] = [
        (Self::Error, "Refused or failed calls; logged always"),
        (Self::Warning, "Unusual values; the simulation continues"),
        (Self::Discard, "Refused values and discarded steps"),
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

/// The host's logger.
pub trait Sink: Send {
    /// Passes on a message.
    fn send(&self, status: Status, category: Category, message: &str);
}

/// The host's logger, and which messages it receives.
pub struct Log {
    sink: Option<Box<dyn Sink>>,
    /// Whether debug logging is on.
    logging_on: bool,
    /// Categories that the host chose, a bit each.
    categories: u8,
}

impl Log {
    /// A log into `sink`, if the host has a logger.
    pub fn new(sink: Option<Box<dyn Sink>>, logging_on: bool) -> Self {
        Self { sink, logging_on, categories: ALL_CATEGORIES }
    }

    /// Sets what is logged; returns the names of unknown categories. No names mean all categories.
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

    /// Whether messages of a call that returns OK are logged in `category`.
    #[inline]
    pub fn is_on(&self, category: Category) -> bool {
        self.logging_on && self.is_chosen(category)
    }

    fn is_chosen(&self, category: Category) -> bool {
        self.categories & (1 << category as u8) != 0
    }

    /// An event during a call that returns OK.
    pub fn event(&self, message: &str) {
        if self.is_on(Category::Events) {
            self.send(Status::Ok, Category::Events, message);
        }
    }

    /// A warning during a call that returns OK.
    pub fn warning(&self, message: &str) {
        if self.is_on(Category::Warning) {
            self.send(Status::Warning, Category::Warning, message);
        }
    }

    /// The reason why a call returns `status`, which is not OK.
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

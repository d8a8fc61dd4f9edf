//! Shared tools: tables, marked sections of documents, paths, progress, Python. They are independent of gears, of the
//! FMU and of other modules.

pub mod files;
pub mod lock;
pub mod paths;
pub mod program;
pub mod progress;
pub mod python;
pub mod script;
pub mod sections;

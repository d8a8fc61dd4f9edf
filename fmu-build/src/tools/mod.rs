//! Shared tools: tables, marked sections of documents, paths, progress, Python. Nothing here knows gears or the FMU, and
//! nothing here uses another module.

pub mod files;
pub mod lock;
pub mod paths;
pub mod program;
pub mod progress;
pub mod python;
pub mod script;
pub mod sections;

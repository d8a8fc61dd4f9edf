//! Builds the FMU and its Python package, and runs the study with them. A module uses only modules above it in this
//! list; [`command_line`] joins the commands of all modules. The crate `lab` measures and checks.
//!
//! - [`tools`]: shared tools, independent of gears
//! - [`fmu`]: builds the FMU
//! - [`study`]: the default command
//! - [`environment`]: Python environments for the scripts of the laboratory

#![warn(missing_docs)]

pub mod command_line;
pub mod environment;
pub mod fmu;
pub mod study;
pub mod tools;

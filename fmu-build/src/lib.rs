//! What builds the FMU and its Python package, and runs the study with them. A room uses only rooms above it in this list;
//! [`command_line`] joins the commands of all rooms. What measures and checks is the crate `lab`.
//!
//! - [`tools`]: shared tools without gears in them
//! - [`fmu`]: builds the FMU
//! - [`study`]: the first command

#![warn(missing_docs)]

pub mod command_line;
pub mod fmu;
pub mod study;
pub mod tools;

//! What builds the FMU and what users ask, in rooms by reader. A room uses only rooms above it in this list;
//! [`command_line`] joins the commands of all rooms. What measures and checks is the crate `lab`.
//!
//! - [`tools`]: shared tools without gears in them
//! - [`fmu`]: builds the FMU
//! - [`gears`]: what a user of gears runs

#![warn(missing_docs)]

pub mod command_line;
pub mod fmu;
pub mod gears;
pub mod tools;

//! Commands around the FMU, in rooms by reader. A room uses only rooms above it in this list; [`command_line`] joins the
//! commands of all rooms.
//!
//! - [`tools`]: shared tools without gears in them
//! - [`fmu`]: builds the FMU
//! - [`gears`]: what a user of gears runs
//! - [`measure`]: what accuracy, solids and couplings cost, also in other programs
//! - [`check`]: what must hold before a change lands

#![warn(missing_docs)]

pub mod check;
pub mod command_line;
pub mod fmu;
pub mod gears;
pub mod measure;
pub mod tools;

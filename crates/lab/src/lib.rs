//! The laboratory: measurements and checks of the library. Users do not need it, and their commands do not compile it.
//!
//! - [`measure`]: cost of accuracy, solids and couplings, also in other programs
//! - [`check`]: requirements for a change
//! - [`all`]: runs every command of both
//! - [`tools`]: shared tools in addition to those of `fmu_build`

#![warn(missing_docs)]

pub mod all;
pub mod check;
pub mod command_line;
pub mod measure;
pub mod tools;

//! The laboratory: measurements and checks of the library. Users do not need it, and their commands do not compile it.
//!
//! - [`measure`]: time and error of this program, of solid teeth, of coupled FMUs, and of other programs on the same
//!   cases
//! - [`check`]: commands that fail if the library breaks a promise
//! - [`all`]: runs every command of both
//! - [`tools`]: tools for both, in addition to the tools of `fmu_build`

#![warn(missing_docs)]

pub mod all;
pub mod check;
pub mod command_line;
pub mod measure;
pub mod tools;

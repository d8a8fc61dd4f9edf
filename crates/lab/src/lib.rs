//! The laboratory: what measures the library and what checks it. Users need none of it, and no command of theirs compiles it.
//!
//! - [`measure`]: what accuracy, solids and couplings cost, also in other programs
//! - [`check`]: what must hold before a change lands
//! - [`all`]: every command of both in one go
//! - [`tools`]: what both share, beside the tools of `fmu_build`

#![warn(missing_docs)]

pub mod all;
pub mod check;
pub mod command_line;
pub mod measure;
pub mod tools;

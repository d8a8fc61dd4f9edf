//! Answers to users' questions about the gears, in addition to simulation. The crate uses the library of the FMU. It
//! neither builds, measures nor prints anything: questions, answers and errors are values.
//!
//! - [`scene`]: scene files, their plans, runs and tooth loads
//! - [`accuracy`]: the cheapest model that is accurate enough
//! - [`geometry`]: dimensions, curves and solids of the gears, interference
//! - [`pattern`]: contact patterns and pressures on the flanks
//! - [`ask`]: one function for all of these, also for C and Python
//! - [`text`]: tables, numbers and files of text; [`problem`]: errors; [`progress`]: reports to a caller, who may stop
//!   the work

#![warn(missing_docs)]
#![deny(unsafe_code)]
#![allow(clippy::result_large_err)] // problems are rare and contain much information

pub mod accuracy;
pub mod ask;
pub mod geometry;
pub mod pattern;
pub mod problem;
pub mod progress;
pub mod scene;
pub mod text;

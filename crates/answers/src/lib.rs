//! What users of the gears ask beside simulating them. It stands on the library of the FMU and builds, measures and prints
//! nothing: a question is a value, so is its answer, and so is what is wrong with it.
//!
//! - [`scene`]: scene files, what they plan, their runs and tooth loads
//! - [`accuracy`]: the cheapest model that is accurate enough
//! - [`geometry`]: dimensions, curves and solids of the gears, interference
//! - [`pattern`]: where flanks carry, and how much
//! - [`ask`]: all of these by one function, from C and Python too
//! - [`text`]: tables, numbers and files of text; [`problem`]: what is wrong; [`progress`]: reports to a caller, who may stop the work

#![warn(missing_docs)]
#![deny(unsafe_code)]
#![allow(clippy::result_large_err)] // problems are rare and say much

pub mod accuracy;
pub mod ask;
pub mod geometry;
pub mod pattern;
pub mod problem;
pub mod progress;
pub mod scene;
pub mod text;

//! Tools around the FMU: its model description, its archive, and the study and tests run on it by fmpy.

#![warn(missing_docs)]

pub mod columns;
pub mod comparison;
pub mod cost;
pub mod describe;
pub mod documentation;
pub mod drivetrain;
pub mod effects;
pub mod evaluation;
pub mod foreign;
pub mod fuzz;
pub mod geometry;
pub mod hosts;
pub mod libraries;
pub mod licences;
pub mod marked;
pub mod memory;
pub mod off;
pub mod package;
pub mod pattern;
pub mod peers;
pub mod places;
pub mod plain_types;
pub mod platforms;
pub mod progress;
pub mod published;
pub mod python;
pub mod real_time;
pub mod report;
pub mod scene;
pub mod script;
pub mod solids;
pub mod stepping;
pub mod study;
pub mod theory;
pub mod toolchains;
pub mod xml;

//! Dynamics of a bevel gear differential: geometry, tooth contact, model, integration, and FMI interfaces.
//!
//! Modules, each of which uses only those before it: `numeric` → `declaration` → `drives` → `geometry` → `friction`,
//! `contact` → `strength` → `integrate` → `model` → `variables` → `instance` → `fmi2`, `fmi3`.
//!
//! Programs in Rust start with [`Differential`], which sets, runs and reads a differential by the names of the FMU's
//! variables.
//!
//! All quantities are in SI units (m, rad, s, kg, N) unless a name says otherwise. Symbols follow ISO 23509.

#![deny(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)] // so that unit tests can share helpers with the test programs
extern crate self as bevel_differential;

#[macro_use]
pub mod problem;
#[macro_use]
mod spec;
mod static_memory;

#[macro_use]
pub mod declaration;

pub mod contact;
mod differential;
mod drives;
pub mod friction;
pub mod geometry;
pub mod integrate;
pub mod model;
pub mod numeric;
pub mod strength;
pub mod variables;

pub use differential::{Differential, DifferentialError};

/// True in full builds. Builds for real-time targets omit some features; see the feature `full` in `Cargo.toml`.
pub const FULL: bool = cfg!(feature = "full");

// only the C ABI handles foreign pointers
#[allow(unsafe_code)]
pub mod fmi2;
#[allow(unsafe_code)]
#[cfg(feature = "full")]
pub mod fmi3;
#[allow(unsafe_code)]
pub mod instance;

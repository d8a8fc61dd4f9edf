//! The FMI 2.0 interface for co-simulation and model exchange: a C ABI around an instance.
//!
//! `exports` contains the C functions. They check pointers and pass safe values to `Instance`, which implements
//! everything that both versions of FMI share. The equations are in `model`, the variables in `variables`.

mod calls;
mod exports;
mod logger;
#[cfg(test)]
#[path = "tests/panics.rs"]
mod panics;
mod types;

pub use crate::instance::{Category, EVENT_INDICATORS, OUTPUT_ORDER, Phase};
pub use calls::{Call, INTERFACE};
pub use exports::*;
pub use types::*;

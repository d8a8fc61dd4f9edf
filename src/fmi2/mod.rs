//! The FMI 2.0 interface for co-simulation and model exchange: a C ABI around an instance.
//!
//! `calls` and `special` contain the C functions. They check pointers and pass safe values to `Instance`, which
//! implements everything that both versions of FMI share. The equations are in `model`, the variables in `variables`.

mod calls;
mod logger;
#[cfg(test)]
#[path = "tests/panics.rs"]
mod panics;
mod special;
mod types;

pub use crate::instance::{Category, EVENT_INDICATORS, OUTPUT_ORDER, Phase};
pub use calls::*;
pub use special::*;
pub use types::*;

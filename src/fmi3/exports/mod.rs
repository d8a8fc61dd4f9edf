//! The C functions. Each checks its pointers, calls the instance and returns a status.
//!
//! # Safety
//! For all of them: an instance comes from `fmi3Instantiate…` and was not freed, and every pointer that is not NULL points to
//! what FMI 3.0 says for as long as the call lasts. NULL and misaligned pointers are refused where FMI requires a value.

#![allow(clippy::missing_safety_doc)] // the section above holds for all
#![allow(non_snake_case)] // FMI's names

use super::types::*;
use super::{Call, INTERFACE, values};
use crate::instance::c_types::c_void;
#[cfg(feature = "full")]
use crate::instance::{CallError, c_types::c_int, getters, host_solver};
use crate::instance::{HostMemory, Instance, call, debug_logging, plain};

#[cfg(feature = "full")]
mod clocks;
#[cfg(feature = "full")]
mod derivatives;
mod exchange;
mod lifecycle;
#[cfg(feature = "full")]
mod others;
mod states;
mod stepping;
mod variables;

#[cfg(feature = "full")]
pub use clocks::*;
#[cfg(feature = "full")]
pub use derivatives::*;
pub use exchange::*;
pub use lifecycle::*;
#[cfg(feature = "full")]
pub use others::*;
pub use states::*;
pub use stepping::*;
pub use variables::*;

//! The C functions. Each checks its pointers, calls the instance and returns a status.
//!
//! # Safety
//! For all of them: a component comes from `fmi2Instantiate` and was not freed, and every pointer that is not NULL points to
//! what FMI 2.0 says for as long as the call lasts. NULL and misaligned pointers are refused where FMI requires a value.

#![allow(clippy::missing_safety_doc)] // the section above holds for all
#![allow(non_snake_case)] // FMI's names

use super::types::*;
use super::{Call, INTERFACE};
use crate::instance::c_types::{c_char, c_int};
use crate::instance::{CallError, CallResult, HostMemory, call, debug_logging, plain};
#[cfg(feature = "full")]
use crate::instance::{getters, host_solver};

mod derivatives;
#[cfg(feature = "full")]
mod exchange;
mod lifecycle;
mod states;
mod stepping;
mod variables;

pub use derivatives::*;
#[cfg(feature = "full")]
pub use exchange::*;
pub use lifecycle::*;
pub use states::*;
pub use stepping::*;
pub use variables::*;

//! The C functions. Each checks its pointers and calls the instance. Most functions return a status.
//!
//! # Safety
//! These rules apply to all functions. A component comes from `fmi2Instantiate` and was not freed. Every pointer that
//! is not NULL points to what FMI 2.0 specifies for as long as the call lasts. NULL and misaligned pointers are refused
//! if FMI requires a value.

#![allow(clippy::missing_safety_doc)] // the section above applies to all
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

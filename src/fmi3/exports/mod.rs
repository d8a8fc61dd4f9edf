//! The C functions. Each checks its pointers and calls the instance. Most functions return a status.
//!
//! # Safety
//! These rules apply to all functions. An instance comes from `fmi3Instantiate…` and was not freed. Every pointer that
//! is not NULL points to what FMI 3.0 specifies for as long as the call lasts. NULL and misaligned pointers are refused
//! if FMI requires a value.

#![allow(clippy::missing_safety_doc)] // the section above applies to all
#![allow(non_snake_case)] // FMI's names

use super::types::*;
use super::{Call, INTERFACE, values};
use crate::instance::c_types::c_void;
use crate::instance::{
    CallError, HostMemory, Instance, c_types::c_int, call, debug_logging, getters, host_solver, plain,
};

mod clocks;
mod derivatives;
mod exchange;
mod lifecycle;
mod others;
mod states;
mod stepping;
mod variables;

pub use clocks::*;
pub use derivatives::*;
pub use exchange::*;
pub use lifecycle::*;
pub use others::*;
pub use states::*;
pub use stepping::*;
pub use variables::*;

//! The C functions. Each checks its pointers, calls the instance and returns a status.
//!
//! # Safety
//! For all of them: an instance comes from `fmi3Instantiate…` and was not freed, and every pointer that is not NULL points to
//! what FMI 3.0 says for as long as the call lasts. NULL and misaligned pointers are refused where FMI requires a value.

#![allow(clippy::missing_safety_doc)] // the section above holds for all
#![allow(non_snake_case)] // FMI's names

use super::types::*;
use super::{Call, FACE, values};
use crate::instance::c_types::{c_int, c_void};
use crate::instance::{CallError, HostMemory, Instance, run};

/// Carries out a call: `body` checks its pointers and passes them on.
macro_rules! call {
    ($c:expr, $call:ident, |$instance:pat_param, $host:pat_param| $body:expr) => {{
        let body = |$instance: &mut Instance, $host: &HostMemory| $body;
        // SAFETY: the host's promise, see the module
        unsafe { run($c, Call::$call, body) }
    }};
}

/// Functions that take an instance and nothing else.
macro_rules! plain {
    ($($function:ident $call:ident $method:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(c: ComponentPointer) -> Status {
            call!(c, $call, |instance, _| instance.$method())
        }
    )+};
}

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

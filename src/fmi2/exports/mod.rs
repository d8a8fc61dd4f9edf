//! The C functions. Each takes its pointers apart, calls the instance, and answers with a status; no more.
//!
//! # Safety
//! For all of them: a component comes from `fmi2Instantiate` and was not freed, and every pointer that is not NULL points to
//! what FMI 2.0 says it does for as long as the call lasts. NULL is always checked for, and refused where FMI needs a value.

#![allow(clippy::missing_safety_doc)] // told above, once for all
#![allow(non_snake_case)] // FMI's names

/// Functions that take an instance and nothing else.
macro_rules! plain {
    ($($function:ident $call:ident $method:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(c: ComponentPointer) -> Status {
            // SAFETY: the host's promise, see the module
            unsafe { run(c, Call::$call, Instance::$method) }
        }
    )+};
}

mod derivatives;
mod exchange;
mod lifecycle;
mod states;
mod stepping;
mod variables;

pub use derivatives::*;
pub use exchange::*;
pub use lifecycle::*;
pub use states::*;
pub use stepping::*;
pub use variables::*;

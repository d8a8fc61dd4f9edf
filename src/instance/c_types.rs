//! C types of the arguments of FMI functions.

#[cfg(target_family = "wasm")]
pub use core::ffi::{c_char, c_int, c_uint, c_void};

#[cfg(not(target_family = "wasm"))]
pub use libc::{c_char, c_int, c_uint, c_void};

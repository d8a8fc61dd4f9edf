//! Library that is translated to C: the functions of FMI 2.0 with additional functions for the surrounding C code.
//! These provide room for the values of a call, an instance that stores its messages, the reason of a panic, and the
//! number of allocations.
//!
//! One such library with its separate memory is one instance of the unit. Pointers are indices into that memory; 0 is
//! NULL.
#![cfg(target_family = "wasm")]

mod allocator;
mod begin;
mod messages;
mod reason;
mod room;

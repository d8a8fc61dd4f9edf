//! The library that is turned into C: the functions of FMI 2.0, and functions that the C around it needs: room for the values of a
//! call, an instance that keeps its messages, the reason of a panic, and how often memory was allocated.
//!
//! One such library, with a memory of its own, is one instance of the unit. Pointers are places in that memory, 0 is NULL.
#![cfg(target_family = "wasm")]

mod allocator;
mod begin;
mod messages;
mod reason;
mod room;

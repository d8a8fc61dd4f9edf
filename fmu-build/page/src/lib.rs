//! The library in a browser: the functions of FMI 2.0 with additional functions for the page. These provide memory to
//! pass values, instances that store their messages, the surfaces of the gears, and the schedule of a run.
//!
//! A page has one thread, and its memory is one array: pointers are indices into it.
#![cfg(target_family = "wasm")]

mod gears;
mod instances;
mod memory;

pub use schedule::bd_schedule;

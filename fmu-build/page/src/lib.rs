//! The library in a browser: the functions of FMI 2.0, and beside them what a page needs: memory to pass values in, instances
//! that keep their messages, the surfaces of the gears, and the schedule of a run.
//!
//! A page is one thread, and its memory is one array: pointers are places in it.
#![cfg(target_family = "wasm")]

mod gears;
mod instances;
mod memory;

pub use schedule::bd_schedule;

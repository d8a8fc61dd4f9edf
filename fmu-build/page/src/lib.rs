//! The library in a browser: the functions of FMI 2.0, and beside them what a page needs: memory to pass values in, instances
//! that keep their messages, and the surfaces of the gears.
//!
//! A page is one thread, and its memory is one array: pointers are places in it.
#![cfg(target_family = "wasm")]

mod gears;
mod instances;
mod memory;

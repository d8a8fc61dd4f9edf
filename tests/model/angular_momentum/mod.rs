//! The angular momentum of a differential about its axle, and the torques that change it, computed apart from the program:
//! masses from the surfaces of the exported solids, forces of the teeth placed in space, and laws of drives and bearings
//! written here anew.
//!
//! About the axle the carrier turns with its planets, or each planet with its pin, and the side gears with their ends. A
//! planet's spin is about an axis across the axle and has no part in it.

#![allow(dead_code)] // each test binary uses its own part

pub mod balance;
pub mod solids;
pub mod space;

pub use balance::Differential;

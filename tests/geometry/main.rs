//! Geometry of a pair of gears against golden numbers, and its checks.

mod checks;
mod golden;

//! Geometry of a pair of gears, compared with golden numbers, and its checks.

mod action;
mod checks;
mod golden;
mod interference;
mod mass;
mod solid;

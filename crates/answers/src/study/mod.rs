//! The study that this program replaces: what to simulate for it, and the comparison with it and with theory.

pub mod comparison;
pub mod evaluation;
pub mod report;
pub mod stated;
pub mod theory;

//! Tools that only the laboratory needs, beside those of `fmu_build`.

pub mod command;
pub mod random;
pub mod script;

//! Tools that only the laboratory needs, beside those of `fmu_build`.

pub mod places;
pub mod random;
pub mod scripted;

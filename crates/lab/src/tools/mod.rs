//! Tools that only the laboratory needs, in addition to those of `fmu_build`.

pub mod command;
#[path = "../../../../tests/common/random.rs"]
pub mod random;
pub mod script;

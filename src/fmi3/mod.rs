//! The FMI 3.0 interface for co-simulation and model exchange: a thin C ABI around an instance, like `fmi2`.
//!
//! The interface contains the variables of FMI 2.0 with the same value references. The module `variables` adds the
//! time, arrays over planets and tooth pairs, event indicators, and the last event. Scheduled execution, clocks and
//! binary variables are not provided.

mod calls;
mod logger;
mod special;
mod types;
mod values;
pub mod variables;

pub use calls::*;
pub use special::*;
pub use types::*;

//! The FMI 3.0 interface for co-simulation and model exchange: a C ABI around an instance, as thin as the one of FMI
//! 2.0.
//!
//! It has the variables of FMI 2.0 with the same value references, and additional variables (`variables`): the time,
//! arrays over planets and tooth pairs, event indicators, and the last event. Scheduled execution, clocks and binary
//! variables are not provided.

mod calls;
mod exports;
mod logger;
mod types;
mod values;
pub mod variables;

pub use calls::{Call, INTERFACE};
pub use exports::*;
pub use types::*;

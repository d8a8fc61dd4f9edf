//! The FMI 2.0 interface for co-simulation and model exchange: a C ABI around the model, and the only folder with `unsafe`.
//!
//! `exports` holds the C functions. They check pointers (`host_memory`, `component`) and pass safe values to `Instance`, which
//! implements FMI's rules. The equations are in `model`, the variables in `variables`.
//!
//! Three decisions that the standard leaves open:
//! - A refused call changes nothing, so the instance keeps its state: fmi2Error for a wrong value reference does not end a
//!   simulation. Only a failed initialisation and an internal error lead to the state `error`.
//! - The state `fatal` is never entered: instances share no mutable data, so fmi2Reset always restores an instance.
//! - Parameters and inputs can be read in any state, outputs from initialisation mode on.

mod c_types;
mod call_error;
mod calls;
mod component;
mod derivatives;
mod exchange;
mod exports;
mod host_memory;
mod instance;
mod log;
mod panic_guard;
#[cfg(test)]
#[path = "tests/panics.rs"]
mod panics;
mod snapshot;
mod types;
mod values;

use call_error::{CallError, CallResult};
pub use calls::{Call, Phase};
pub use derivatives::OUTPUT_ORDER;
pub use exchange::EVENT_INDICATORS;
pub use exports::*;
use host_memory::{HostMemory, InputArray, OutputArray};
use instance::{Experiment, Instance};
pub use log::{Category, Log};
use snapshot::Snapshot;
pub use types::*;

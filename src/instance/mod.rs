//! FMU instance behind both versions of FMI: its states, values, steps, events and derivatives, on top of
//! `model::Simulation`. This module also checks access to the memory that a host passes by pointers. `fmi2` and `fmi3`
//! are thin interfaces on top of it.
//!
//! Decisions that the standards leave open:
//! - A refused call changes nothing, so the instance keeps its state. For example, an error for a wrong value reference
//!   does not end a simulation. Only a failed initialisation and an internal error lead to the state `error`.
//! - The state `fatal` is never entered. Instances share no mutable data, so a reset always restores an instance.
//! - Parameters and inputs can be read in any state, and outputs from initialisation mode on.
//! - A stop time and a tolerance announced to an instance take precedence over those of a restored state. The start
//!   time belongs to the state, like its time.
//! - A stop time may equal the start time. The start can then be read and saved, but no step is possible.

mod basic;
pub mod c_types;
mod call_error;
mod component;
mod derivatives;
mod exchange;
mod float_traps;
mod host_memory;
mod initial_derivatives;
mod input_ramp;
#[allow(clippy::module_inception)]
mod instance;
mod log;
mod phase;
mod sensitivity;
mod snapshot;
mod steps;
mod stored;
mod unknowns;
pub(crate) mod values;

pub use basic::*;
pub use call_error::{CallError, CallResult};
pub use component::{Component, catch, create, free, run};
pub(crate) use component::{calls, export};
#[cfg(feature = "full")]
pub(crate) use component::{completed_step, filled};
pub use derivatives::OUTPUT_ORDER;
pub use exchange::EVENT_INDICATORS;
pub use host_memory::{HostMemory, InputArray, Output, OutputArray};
pub use instance::{Experiment, Instance};
pub use log::{Category, Log, Sink};
pub(crate) use phase::states;
pub use phase::{Call, Phase};
pub use snapshot::Snapshot;
pub use steps::{Allowed, Discrete, Ended, Iteration};

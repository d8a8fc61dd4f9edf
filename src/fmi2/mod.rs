//! The FMI 2.0 face, for co-simulation and for model exchange: a C ABI around the model, and the only room with `unsafe`.
//!
//! `exports` takes foreign pointers apart and hands safe values to `Instance`, which knows FMI's rules but no pointer;
//! the equations are in `model`, the variables in `variables`.
//!
//! Three decisions that the standard leaves open:
//! - A refused call has changed nothing, so the instance keeps its state: fmi2Error for a wrong value reference, say, does
//!   not end a simulation. Only a failed initialisation and an internal error lead to the state `error`.
//! - The state `fatal` is never entered: instances share nothing, so whatever happens to one, fmi2Reset rebuilds it.
//! - Parameters and inputs can be read in any state; outputs from initialisation mode on.

mod calls;
mod derivatives;
mod exchange;
mod exports;
mod instance;
mod log;
#[cfg(test)]
mod panics;
mod pointers;
mod quiet;
mod refusal;
mod snapshot;
mod types;
mod values;

pub use calls::Phase;
pub use derivatives::OUTPUT_ORDER;
pub use exchange::EVENT_INDICATORS;
pub use exports::*;
pub use log::Category;
pub use types::*;

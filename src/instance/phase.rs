//! States of an instance, and the calls that are legal in each state.
//!
//! Model exchange and co-simulation share the states before the start and after the end. In between, each has its own
//! states, so one table serves both. A call of only one kind that is legal in a shared state also checks the instance's
//! kind.

use serde::{Deserialize, Serialize};

use super::{CallError, CallResult};

/// State of an instance in FMI's state machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Phase {
    /// The instance was created or reset.
    Instantiated = 0,
    /// The instance is in initialization mode.
    Initialization = 1,
    /// Co-simulation: the instance is ready for a step. Called step mode in FMI 3.0.
    StepComplete = 2,
    /// A step was discarded. Values are those of the last successful time.
    StepFailed = 3,
    /// The simulation has ended.
    Terminated = 4,
    /// Initialisation failed, or an internal error occurred.
    Error = 5,
    /// The instance is at an event.
    Event = 6,
    /// Model exchange: the instance is between events.
    ContinuousTime = 7,
    /// FMI 3.0: structural parameters may be set.
    Configuration = 8,
    /// FMI 3.0, co-simulation: the host is called back within a step.
    IntermediateUpdate = 9,
}

impl Phase {
    /// All states, in the order in which messages list them.
    pub const ALL: [Self; 10] = {
        use Phase::*;
        [
            Instantiated,
            Configuration,
            Initialization,
            StepComplete,
            IntermediateUpdate,
            StepFailed,
            Event,
            ContinuousTime,
            Terminated,
            Error,
        ]
    };

    /// Returns the state as a bit.
    pub const fn bit(self) -> u16 {
        1 << self as u8
    }

    /// True if a simulation is running.
    pub fn is_running(self) -> bool {
        matches!(self, Self::StepComplete | Self::Event | Self::ContinuousTime | Self::IntermediateUpdate)
    }

    /// Returns the name for messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initialization mode",
            Self::StepComplete => "step complete",
            Self::StepFailed => "step failed",
            Self::Terminated => "terminated",
            Self::Error => "error",
            Self::Event => "event mode",
            Self::ContinuousTime => "continuous-time mode",
            Self::Configuration => "configuration mode",
            Self::IntermediateUpdate => "intermediate update mode",
        }
    }
}

/// A C function that is called on an instance.
#[derive(Clone, Copy, Debug)]
pub struct Call {
    /// Version of FMI that has the function.
    pub version: u32,
    /// Name of the function, and the name of its family if messages have that instead.
    pub names: &'static [&'static str],
    /// States in which the call is legal, as a bit mask.
    pub phases: u16,
}

impl Call {
    /// Returns the name in messages.
    pub fn name(&self) -> &'static str {
        self.names.last().copied().unwrap_or_default()
    }

    /// True if the call is legal in `phase`.
    pub fn is_legal(&self, phase: Phase) -> bool {
        self.phases & phase.bit() != 0
    }

    /// Refuses a call that is not legal in `phase`.
    pub fn check(&self, phase: Phase) -> CallResult {
        if self.is_legal(phase) { Ok(()) } else { Err(illegal(self.phases, phase)) }
    }
}

#[cold]
fn illegal(phases: u16, phase: Phase) -> CallError {
    let legal: Vec<_> = Phase::ALL.into_iter().filter(|p| phases & p.bit() != 0).map(Phase::name).collect();
    let states = if legal.is_empty() { "no state of this FMU".into() } else { format!("\"{}\"", legal.join("\", \"")) };
    let remedy = match phase {
        Phase::Instantiated => "; initialise the unit first",
        Phase::StepFailed => "; restore a saved state, or reset the unit",
        Phase::Terminated | Phase::Error => "; reset the unit",
        _ => "",
    };
    CallError::error(format!("not legal in the state \"{}\"; legal in {states}{remedy}", phase.name()))
}

/// States as bits, for the tables of calls.
pub mod states {
    use super::Phase;

    pub const INSTANTIATED: u16 = Phase::Instantiated.bit();
    pub const CONFIGURATION: u16 = Phase::Configuration.bit();
    pub const INITIALIZATION: u16 = Phase::Initialization.bit();
    pub const COMPLETE: u16 = Phase::StepComplete.bit();
    pub const INTERMEDIATE: u16 = Phase::IntermediateUpdate.bit();
    pub const FAILED: u16 = Phase::StepFailed.bit();
    pub const EVENT: u16 = Phase::Event.bit();
    pub const CONTINUOUS: u16 = Phase::ContinuousTime.bit();
    pub const TERMINATED: u16 = Phase::Terminated.bit();
    pub const ERROR: u16 = Phase::Error.bit();
    pub const ALWAYS: u16 = (1 << Phase::ALL.len()) - 1;
}

//! States of an instance, and which call is legal in which of them.
//!
//! Model exchange and co-simulation share the states before the start and after the end; in between, each has its own
//! states, so one table serves both. A call of one kind alone that is legal in a shared state also checks the
//! instance's kind.

use serde::{Deserialize, Serialize};

use super::{CallError, CallResult, Interface};

/// State of an instance in FMI's state machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Phase {
    /// After the instance was made, or reset.
    Instantiated = 0,
    /// Initialization mode.
    Initialization = 1,
    /// Co-simulation: ready for a step; step mode of FMI 3.0.
    StepComplete = 2,
    /// A step was discarded; values are those of the last successful time.
    StepFailed = 3,
    /// After the end.
    Terminated = 4,
    /// Initialisation failed, or an internal error.
    Error = 5,
    /// At an event.
    Event = 6,
    /// Model exchange, between events.
    ContinuousTime = 7,
    /// FMI 3.0: structural parameters may be set.
    Configuration = 8,
    /// FMI 3.0, co-simulation: within a step, while the host is called back.
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

    /// The state as a bit.
    pub const fn bit(self) -> u16 {
        1 << self as u8
    }

    /// Whether a simulation runs.
    pub fn is_running(self) -> bool {
        matches!(self, Self::StepComplete | Self::Event | Self::ContinuousTime | Self::IntermediateUpdate)
    }

    /// Name in messages.
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

/// A function of FMI that is legal in certain states only.
pub trait LegalCall: Copy {
    /// The version of FMI that has it.
    const INTERFACE: &'static Interface;

    /// Name of the C function.
    fn name(self) -> &'static str;

    /// States in which the call is legal, a bit each.
    fn phases(self) -> u16;

    /// Whether the call is legal in `phase`.
    fn legal(self, phase: Phase) -> bool {
        self.phases() & phase.bit() != 0
    }

    /// Refuses a call that is not legal in `phase`.
    fn check(self, phase: Phase) -> CallResult {
        if self.legal(phase) {
            return Ok(());
        }
        Err(illegal(self.phases(), phase))
    }
}

#[cold]
fn illegal(phases: u16, phase: Phase) -> CallError {
    let legal: Vec<_> = Phase::ALL.into_iter().filter(|p| phases & p.bit() != 0).map(Phase::name).collect();
    let states = if legal.is_empty() { "no state of this FMU".into() } else { format!("\"{}\"", legal.join("\", \"")) };
    CallError::error(format!("not legal in the state \"{}\"; legal in {states}", phase.name()))
}

/// The table of calls of a version of FMI: an enum `Call` of rows `Name "function" states;`.
macro_rules! calls {
    ($interface:expr; $($call:ident $name:literal $phases:expr;)+) => {
        /// A function of FMI that is legal in certain states only.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs)]
        pub enum Call { $($call),+ }

        impl Call {
            /// All calls.
            #[cfg(test)]
            pub const ALL: &[Self] = &[$(Self::$call),+];
        }

        impl $crate::instance::LegalCall for Call {
            const INTERFACE: &'static $crate::instance::Interface = $interface;

            fn name(self) -> &'static str {
                match self { $(Self::$call => $name),+ }
            }

            fn phases(self) -> u16 {
                match self { $(Self::$call => $phases),+ }
            }
        }
    };
}

pub(crate) use calls;

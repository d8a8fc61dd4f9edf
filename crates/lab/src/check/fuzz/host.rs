//! The host's side of an instance: options, the log, and the updates within steps.

use std::cell::{Cell, RefCell};

use bevel_differential::instance::{ComponentPointer, Kind};
use fastrand::Rng;

use crate::tools::random::Draws;

#[path = "../../../../../tests/common/recorder.rs"]
mod recorder;

pub use recorder::{Line, Recorder};

/// Options of an instance.
#[derive(Clone, Copy, Debug)]
pub struct Making {
    /// Model exchange or co-simulation.
    pub kind: Kind,
    /// True if debug logging is on from the start.
    pub logs: bool,
    /// FMI 3.0, co-simulation: the host handles events in event mode.
    pub events: bool,
    /// FMI 3.0, co-simulation: a step may end at an event.
    pub early: bool,
    /// FMI 3.0, co-simulation: the host is called back within steps.
    pub updates: bool,
}

impl Making {
    /// Draws everything but the kind.
    pub fn drawn(r: &mut Rng, kind: Kind) -> Self {
        Self { kind, logs: r.chance(2), events: r.chance(2), early: r.chance(2), updates: r.chance(3) }
    }
}

/// The host's side of an instance. It stays at its place, since the instance has pointers to it.
pub struct Host {
    /// Lines that the instance logged.
    pub recorder: Recorder,
    /// Updates within steps so far.
    pub updates: Cell<u64>,
    /// The instance, for calls within a step; NULL before it is made.
    pub component: Cell<ComponentPointer>,
    /// First promise that an update within a step broke, in words.
    pub broken: RefCell<Option<String>>,
}

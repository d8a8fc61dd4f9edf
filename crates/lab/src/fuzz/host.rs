//! Host's side of an instance: options, log, and updates during steps.

use std::cell::{Cell, RefCell};

use bevel_differential::instance::{ComponentPointer, Kind};
use fastrand::Rng;

use crate::random::Draws;

#[path = "../../../../tests/common/recorder.rs"]
mod recorder;

pub use recorder::{Line, Recorder};

/// Options of an instance.
#[derive(Clone, Copy, Debug)]
pub struct InstanceOptions {
    /// Model exchange or co-simulation.
    pub kind: Kind,
    /// True if debug logging is on from the start.
    pub logs: bool,
    /// FMI 3.0, co-simulation: the host handles events in event mode.
    pub events: bool,
    /// FMI 3.0, co-simulation: a step may end at an event.
    pub early: bool,
    /// FMI 3.0, co-simulation: the host is called back during steps.
    pub updates: bool,
}

impl InstanceOptions {
    /// Draws all options except the kind.
    pub fn drawn(r: &mut Rng, kind: Kind) -> Self {
        Self { kind, logs: r.chance(2), events: r.chance(2), early: r.chance(2), updates: r.chance(3) }
    }
}

/// Host's side of an instance. It must not move, because the instance has pointers to it.
pub struct Host {
    /// Lines that the instance logged.
    pub recorder: Recorder,
    /// Number of updates during steps so far.
    pub updates: Cell<u64>,
    /// The instance, for calls during a step; NULL before it is created.
    pub component: Cell<ComponentPointer>,
    /// First promise that was broken by an update during a step, as text.
    pub broken: RefCell<Option<String>>,
}

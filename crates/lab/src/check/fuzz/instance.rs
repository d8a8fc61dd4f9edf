//! An instance of the fuzzer, with the host's side of it: its log, and the updates within steps.

use std::cell::{Cell, RefCell};
use std::ptr;

use bevel_differential::instance::{ComponentPointer, FmuState, Kind, Status};
use fastrand::Rng;

use super::version::Version;
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

/// An instance of the fuzzer.
pub struct FuzzedInstance {
    /// The version of FMI whose functions made it.
    pub version: &'static Version,
    /// The instance.
    pub component: ComponentPointer,
    /// Options with which it was made.
    pub making: Making,
    /// The host's side.
    pub host: Box<Host>,
    /// True if its log is filtered by category.
    pub is_filtered: bool,
    /// A state for comparisons, overwritten each time; NULL until it is needed.
    pub comparison_state: FmuState,
    /// True if a tolerance or a stop time was announced: these outlast restored states.
    pub has_announced: bool,
    /// Calls refused one after the other.
    pub refused: usize,
}

impl FuzzedInstance {
    /// A fresh instance; none if it is refused.
    pub fn new(version: &'static Version, making: Making) -> Option<Self> {
        let host = Box::new(Host {
            recorder: Recorder::default(),
            updates: Cell::new(0),
            component: Cell::new(ptr::null_mut()),
            broken: RefCell::new(None),
        });
        let component = (version.make)(&making, &host);
        host.component.set(component);
        (!component.is_null()).then(|| Self {
            version,
            component,
            making,
            host,
            is_filtered: false,
            comparison_state: ptr::null_mut(),
            has_announced: false,
            refused: 0,
        })
    }

    /// Lines logged since the last call of this function.
    pub fn take_log(&self) -> Vec<Line> {
        std::mem::take(&mut *self.host.recorder.lines())
    }

    /// Time of the instance [s], if its state allows the host to read it.
    pub fn time(&self) -> Option<f64> {
        let (mut now, logged) = (f64::NAN, self.host.recorder.lines().len());
        // SAFETY: a live component and a place for a number
        let status = unsafe { (self.version.time)(self.component, &mut now) };
        self.host.recorder.lines().truncate(logged);
        (status == Status::Ok).then_some(now)
    }

    /// The whole state as bytes; none where the standard forbids reading it (after an error).
    pub fn bytes(&mut self) -> Option<Vec<u8>> {
        // SAFETY: a live component; the state is NULL or this instance's own
        let status = unsafe { (self.version.get_state)(self.component, &mut self.comparison_state) };
        let bytes =
            (status == Status::Ok).then(|| serialised(self.version, self.component, self.comparison_state)).flatten();
        self.take_log();
        bytes
    }
}

/// A state as bytes.
pub fn serialised(version: &Version, c: ComponentPointer, state: FmuState) -> Option<Vec<u8>> {
    let mut size = 0;
    // SAFETY: a live component and a live state
    if unsafe { (version.state_size)(c, state, &mut size) } != Status::Ok {
        return None;
    }
    let mut bytes = vec![0u8; size];
    // SAFETY: as above, and room for `size` bytes
    let status = unsafe { (version.serialize)(c, state, bytes.as_mut_ptr(), size) };
    (status == Status::Ok).then_some(bytes)
}

impl Drop for FuzzedInstance {
    fn drop(&mut self) {
        // SAFETY: component and state are this instance's own
        unsafe {
            (self.version.free_state)(self.component, &mut self.comparison_state);
            (self.version.free)(self.component);
        }
    }
}

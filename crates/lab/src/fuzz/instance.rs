//! Instance of the fuzzer, created and inspected with the functions of one version of FMI.

use std::cell::{Cell, RefCell};
use std::ptr;

use bevel_differential::instance::{ComponentPointer, FmuState, Status};

use super::host::{Host, InstanceOptions, Line, Recorder};
use super::interface::Interface;

/// Instance of the fuzzer.
pub struct FuzzedInstance {
    /// Functions of its FMI version.
    pub interface: &'static Interface,
    /// Pointer to the instance.
    pub component: ComponentPointer,
    /// Options of the instance.
    pub options: InstanceOptions,
    /// The host's side.
    pub host: Box<Host>,
    /// True if the log is filtered by category.
    pub is_filtered: bool,
    /// State for comparisons, overwritten each time; NULL until it is needed.
    pub comparison_state: FmuState,
    /// True if a tolerance or a stop time was announced. Announcements survive the restoring of states.
    pub has_announced: bool,
    /// Number of consecutive refused calls.
    pub refused: usize,
}

impl FuzzedInstance {
    /// Creates an instance; `None` if it is refused.
    pub fn new(interface: &'static Interface, options: InstanceOptions) -> Option<Self> {
        let host = Box::new(Host {
            recorder: Recorder::default(),
            updates: Cell::new(0),
            component: Cell::new(ptr::null_mut()),
            broken: RefCell::new(None),
        });
        let component = (interface.make)(&options, &host);
        host.component.set(component);
        (!component.is_null()).then(|| Self {
            interface,
            component,
            options,
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
        let status = unsafe { (self.interface.time)(self.component, &mut now) };
        self.host.recorder.lines().truncate(logged);
        (status == Status::Ok).then_some(now)
    }

    /// Complete state as bytes; `None` if the standard forbids reading it (after an error).
    pub fn bytes(&mut self) -> Option<Vec<u8>> {
        // SAFETY: a live component; the state is NULL or this instance's own
        let status = unsafe { (self.interface.get_state)(self.component, &mut self.comparison_state) };
        let bytes =
            (status == Status::Ok).then(|| serialised(self.interface, self.component, self.comparison_state)).flatten();
        self.take_log();
        bytes
    }
}

/// Serialises a state.
pub fn serialised(interface: &Interface, c: ComponentPointer, state: FmuState) -> Option<Vec<u8>> {
    let mut size = 0;
    // SAFETY: a live component and a live state
    if unsafe { (interface.state_size)(c, state, &mut size) } != Status::Ok {
        return None;
    }
    let mut bytes = vec![0u8; size];
    // SAFETY: as above, and room for `size` bytes
    let status = unsafe { (interface.serialize)(c, state, bytes.as_mut_ptr(), size) };
    (status == Status::Ok).then_some(bytes)
}

impl Drop for FuzzedInstance {
    fn drop(&mut self) {
        // SAFETY: component and state are this instance's own
        unsafe {
            (self.interface.free_state)(self.component, &mut self.comparison_state);
            (self.interface.free)(self.component);
        }
    }
}

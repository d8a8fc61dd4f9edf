//! An instance of the fuzzer and its log.

use std::ffi::CString;
use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::variables::guid;

#[path = "../../../../../tests/common/recorder.rs"]
mod recorder;

pub use recorder::{Line, Recorder};

/// An instance of the fuzzer.
pub struct FuzzedInstance {
    /// The instance.
    pub component: ComponentPointer,
    /// Model exchange (0) or co-simulation (1).
    pub kind: i32,
    /// Lines that it logged.
    pub recorder: Box<Recorder>,
    /// Whether its log is filtered by category.
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
    pub fn new(kind: i32) -> Option<Self> {
        let recorder = Box::<Recorder>::default();
        let guid = CString::new(guid()).ok()?;
        let callbacks = recorder.callbacks();
        // SAFETY: all pointers are valid through the call, and the lines as long as the instance
        let component =
            unsafe { fmi2Instantiate(c"unit".as_ptr(), kind, guid.as_ptr(), ptr::null(), &callbacks, 0, 0) };
        (!component.is_null()).then(|| Self {
            component,
            kind,
            recorder,
            is_filtered: false,
            comparison_state: ptr::null_mut(),
            has_announced: false,
            refused: 0,
        })
    }

    /// Lines logged since the last call of this function.
    pub fn take_log(&self) -> Vec<Line> {
        std::mem::take(&mut *self.recorder.lines())
    }

    /// The whole state as bytes; none where the standard forbids reading it (after an error).
    pub fn bytes(&mut self) -> Option<Vec<u8>> {
        // SAFETY: a live component; the state is NULL or this instance's own
        let status = unsafe { fmi2GetFMUstate(self.component, &mut self.comparison_state) };
        let bytes = if status == Status::Ok { serialised(self.component, self.comparison_state) } else { None };
        self.take_log();
        bytes
    }
}

/// A state as bytes.
pub fn serialised(c: ComponentPointer, state: FmuState) -> Option<Vec<u8>> {
    let mut size = 0;
    // SAFETY: a live component and a live state
    if unsafe { fmi2SerializedFMUstateSize(c, state, &mut size) } != Status::Ok {
        return None;
    }
    let mut bytes = vec![0u8; size];
    // SAFETY: as above, and room for `size` bytes
    let status = unsafe { fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr().cast(), size) };
    (status == Status::Ok).then_some(bytes)
}

impl Drop for FuzzedInstance {
    fn drop(&mut self) {
        // SAFETY: component and state are this instance's own
        unsafe {
            fmi2FreeFMUstate(self.component, &mut self.comparison_state);
            fmi2FreeInstance(self.component);
        }
    }
}

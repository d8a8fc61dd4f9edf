//! An instance of the fuzzer and its log.

use std::ffi::CString;
use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::variables::guid;

#[path = "../../../../../tests/common/recorder.rs"]
mod recorder;

pub use recorder::{Line, Recorder};

/// An instance of the fuzzer.
pub struct Unit {
    /// The instance.
    pub c: ComponentPointer,
    /// Model exchange (0) or co-simulation (1).
    pub kind: i32,
    /// Lines that it logged.
    pub recorder: Box<Recorder>,
    /// Whether its log is filtered by category.
    pub is_filtered: bool,
    /// A state for comparisons, overwritten each time; NULL until it is needed.
    pub kept: FmuState,
    /// Calls refused one after the other.
    pub refused: usize,
}

impl Unit {
    /// A fresh instance; none if it is refused.
    pub fn new(kind: i32) -> Option<Self> {
        let recorder = Box::<Recorder>::default();
        let guid = CString::new(guid()).ok()?;
        let callbacks = recorder.callbacks();
        // SAFETY: all pointers are valid through the call, and the lines as long as the instance
        let c = unsafe { fmi2Instantiate(c"unit".as_ptr(), kind, guid.as_ptr(), ptr::null(), &callbacks, 0, 0) };
        (!c.is_null()).then(|| Self { c, kind, recorder, is_filtered: false, kept: ptr::null_mut(), refused: 0 })
    }

    /// Lines logged since the last call of this function.
    pub fn said(&self) -> Vec<Line> {
        std::mem::take(&mut *self.recorder.lines())
    }

    /// The whole state as bytes; none where the standard forbids reading it (after an error).
    pub fn bytes(&mut self) -> Option<Vec<u8>> {
        // SAFETY: a live component; the state is NULL or this unit's own
        let status = unsafe { fmi2GetFMUstate(self.c, &mut self.kept) };
        let bytes = if status == Status::Ok { serialised(self.c, self.kept) } else { None };
        self.said();
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

impl Drop for Unit {
    fn drop(&mut self) {
        // SAFETY: component and state are this unit's own
        unsafe {
            fmi2FreeFMUstate(self.c, &mut self.kept);
            fmi2FreeInstance(self.c);
        }
    }
}

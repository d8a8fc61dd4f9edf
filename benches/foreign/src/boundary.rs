//! What every C function needs: no panic unwinds into C, and texts fit the caller's buffers.

use std::ffi::{c_char, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Nothing unwinds into C.
pub fn guarded(work: impl FnOnce() -> c_int) -> c_int {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or(-1)
}

/// Writes `text` to `to`, cut to the room there, with a zero at its end.
///
/// # Safety
/// `to` has room for `room` bytes.
pub unsafe fn write(text: &str, to: *mut c_char, room: usize) {
    let Some(most) = room.checked_sub(1) else { return };
    let length = text.len().min(most);
    // SAFETY: as promised by the caller
    unsafe {
        std::ptr::copy_nonoverlapping(text.as_ptr().cast(), to, length);
        *to.add(length) = 0;
    }
}

//! Room for values that a host passes by pointers.

use std::cell::UnsafeCell;

/// Number of words allocated at the start: more than references and values of all variables of the unit.
const WORDS: usize = 1024;

struct Room(UnsafeCell<Vec<u64>>);

// SAFETY: compiled for WebAssembly without threads
unsafe impl Sync for Room {}

static ROOM: Room = Room(UnsafeCell::new(Vec::new()));

/// Allocates the room for all usual calls, so that none allocates later.
pub fn make() {
    source_room(WORDS * size_of::<u64>());
}

/// Returns room for `bytes`, aligned for all numbers, until the next call of this function. It is not cleared.
#[unsafe(no_mangle)]
pub extern "C" fn source_room(bytes: usize) -> *mut u64 {
    // SAFETY: one thread, and no reference outlives this call
    let words = unsafe { &mut *ROOM.0.get() };
    let wanted = bytes.div_ceil(size_of::<u64>());
    if words.len() < wanted {
        words.resize(wanted, 0);
    }
    words.as_mut_ptr()
}

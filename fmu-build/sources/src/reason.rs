//! Reason for a stop of the library: the message of a panic, which in WebAssembly ends in a trap.

use std::cell::UnsafeCell;
use std::fmt::Write as _;

/// Maximum size of the reason in bytes; a longer one is cut.
const MOST: usize = 512;

struct Reason(UnsafeCell<([u8; MOST], usize)>);

// SAFETY: compiled for WebAssembly without threads
unsafe impl Sync for Reason {}

static REASON: Reason = Reason(UnsafeCell::new(([0; MOST], 0)));

/// Writes as much as there is room for, without allocating, because memory may be exhausted.
impl std::fmt::Write for &Reason {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        // SAFETY: one thread, and no other reference
        let (bytes, length) = unsafe { &mut *self.0.get() };
        for (place, byte) in bytes[*length..MOST - 1].iter_mut().zip(text.bytes()) {
            *place = if byte == 0 { b' ' } else { byte };
            *length += 1;
        }
        Ok(())
    }
}

/// Makes later panics store their reason.
pub fn keep() {
    // the library sets its hook only at the first call
    let _ = bevel_differential::instance::catch(|| ());
    std::panic::set_hook(Box::new(|info| {
        let _ = write!(&REASON, "{info}");
    }));
}

/// Returns a pointer to the reason, a text that ends with 0. It is empty if no panic occurred.
#[unsafe(no_mangle)]
pub extern "C" fn source_reason() -> *const u8 {
    REASON.0.get().cast()
}

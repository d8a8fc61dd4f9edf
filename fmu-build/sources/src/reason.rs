//! Why the library stopped: the message of a panic, which in WebAssembly ends in a trap.

use std::cell::UnsafeCell;
use std::fmt::Write as _;

/// Bytes of the reason; the rest is cut.
const MOST: usize = 512;

struct Reason(UnsafeCell<([u8; MOST], usize)>);

// SAFETY: compiled for WebAssembly without threads
unsafe impl Sync for Reason {}

static REASON: Reason = Reason(UnsafeCell::new(([0; MOST], 0)));

/// Writes as much as there is room for, without allocating: memory may be what is lacking.
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

/// From now on panics leave their reason.
pub fn keep() {
    // the library sets its hook at the first call, and not again
    let _ = bevel_differential::instance::catch(|| ());
    std::panic::set_hook(Box::new(|info| {
        let _ = write!(&REASON, "{info}");
    }));
}

/// Where the reason is, a text that ends with 0; empty if no panic stopped the library.
#[unsafe(no_mangle)]
pub extern "C" fn source_reason() -> *const u8 {
    REASON.0.get().cast()
}

//! Messages of an instance, stored until the surrounding C code passes them to the host's logger.

use std::cell::UnsafeCell;
use std::ffi::CStr;

use bevel_differential::instance::{Status, Text};

/// Maximum size of all messages of a call in bytes; longer ones are cut.
const MOST: usize = 8192;

struct Messages(UnsafeCell<Vec<u8>>);

// SAFETY: compiled for WebAssembly without threads
unsafe impl Sync for Messages {}

static MESSAGES: Messages = Messages(UnsafeCell::new(Vec::new()));

fn kept() -> &'static mut Vec<u8> {
    // SAFETY: one thread; callers hold the reference only in their own body, which calls nothing that needs another one
    unsafe { &mut *MESSAGES.0.get() }
}

/// Allocates room for messages, so that storing them allocates nothing.
pub fn make() {
    kept().reserve_exact(MOST);
}

/// Stores a message.
///
/// # Safety
/// `category` and `message` end with 0.
pub unsafe fn keep(status: Status, category: Text, message: Text) {
    // SAFETY: guaranteed by the caller
    let [category, message] = [category, message].map(|text| unsafe { CStr::from_ptr(text) }.to_bytes());
    let text = kept();
    // the status byte and the final zeros of two texts
    let Some(left) = MOST.checked_sub(text.len() + category.len() + 3) else { return };
    text.push(status as u8);
    for part in [category, &message[..message.len().min(left)]] {
        text.extend_from_slice(part);
        text.push(0);
    }
}

/// Returns a pointer to the messages of the last call, one after another: the status of FMI as a byte, the category and
/// the text, both ending with 0. Writes their total size in bytes. They are overwritten by the next message.
///
/// # Safety
/// `bytes` points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn source_messages(bytes: *mut usize) -> *const u8 {
    let text = kept();
    // SAFETY: guaranteed by the caller
    unsafe { bytes.write(text.len()) };
    text.clear();
    text.as_ptr()
}

//! Messages of an instance, kept until the C around the library passes them to the host's logger.

use std::cell::UnsafeCell;
use std::ffi::CStr;

use bevel_differential::instance::{Status, Text};

/// Bytes of all messages of a call; what goes beyond is cut.
const MOST: usize = 8192;

struct Messages(UnsafeCell<Vec<u8>>);

// SAFETY: compiled for WebAssembly without threads
unsafe impl Sync for Messages {}

static MESSAGES: Messages = Messages(UnsafeCell::new(Vec::new()));

fn kept() -> &'static mut Vec<u8> {
    // SAFETY: one thread; callers keep the reference for their own body, which calls nothing that asks for another
    unsafe { &mut *MESSAGES.0.get() }
}

/// Makes room for messages, so that keeping them allocates nothing.
pub fn make() {
    kept().reserve_exact(MOST);
}

/// Keeps a message.
///
/// # Safety
/// `category` and `message` end with 0.
pub unsafe fn keep(status: Status, category: Text, message: Text) {
    // SAFETY: the caller's promise
    let [category, message] = [category, message].map(|text| unsafe { CStr::from_ptr(text) }.to_bytes());
    let text = kept();
    // the status, and two texts that end with 0
    let Some(left) = MOST.checked_sub(text.len() + category.len() + 3) else { return };
    text.push(status as u8);
    for part in [category, &message[..message.len().min(left)]] {
        text.extend_from_slice(part);
        text.push(0);
    }
}

/// Where the messages of the last call are, one after another: the status of FMI as a byte, the category and the text, both ending
/// with 0. Writes how many bytes they are. They are forgotten at the next message.
///
/// # Safety
/// `bytes` points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn source_messages(bytes: *mut usize) -> *const u8 {
    let text = kept();
    // SAFETY: the caller's promise
    unsafe { bytes.write(text.len()) };
    text.clear();
    text.as_ptr()
}

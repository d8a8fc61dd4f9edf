//! Panic guard: a panic inside a call becomes a message for the host's log instead of text on stderr. Floating-point
//! traps of the host are masked.

use std::any::Any;
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

use super::float_traps::MaskedTraps;

thread_local! {
    /// True while this thread is inside a call of this library.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
}

/// Runs `body` with masked floating-point traps. Returns the message of a panic in it, and prints nothing.
pub fn catch<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    // the hook belongs to this library's copy of std; panics elsewhere in the process keep their hook
    HOOK.call_once(|| {
        let previous = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !INSIDE.get() {
                previous(info);
            }
        }));
    });
    let _masked = MaskedTraps::new();
    let outer = INSIDE.replace(true);
    let outcome = panic::catch_unwind(AssertUnwindSafe(body));
    INSIDE.set(outer);
    outcome.map_err(|panic| text(panic.as_ref()).to_owned())
}

fn text(panic: &(dyn Any + Send)) -> &str {
    let owned = panic.downcast_ref::<String>().map(String::as_str);
    owned.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_returned_as_its_message() {
        assert_eq!(catch(|| 1), Ok(1));
        assert_eq!(catch(|| -> i32 { panic!("step {}", 2) }), Err("step 2".into()));
    }
}

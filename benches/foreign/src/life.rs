//! Making and freeing a run, its size and start, its counts and messages.

use std::ffi::{CStr, c_char, c_int};
use std::panic::catch_unwind;

use crate::boundary::write;
use crate::cases;
use crate::run::{Run, boxed};

/// Makes a run; null, with the reason written to `problem`, if there is none such.
///
/// # Safety
/// The texts end with a zero; `problem` has room for `room` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_new(
    case: *const c_char,
    level: *const c_char,
    method: *const c_char,
    tolerance: f64,
    problem: *mut c_char,
    room: usize,
) -> *mut Run {
    let made = catch_unwind(|| {
        // SAFETY: as promised by the caller
        let [case, level, method] =
            [case, level, method].map(|text| unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned());
        cases::case(&case, &level, &method, tolerance)
    });
    match made.unwrap_or_else(|_| Err("panicked".to_owned())) {
        Ok(case) => boxed(case),
        Err(text) => {
            // SAFETY: as promised by the caller
            unsafe { write(&text, problem, room) };
            std::ptr::null_mut()
        }
    }
}

/// # Safety
/// `run` came from [`foreign_new`] and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_free(run: *mut Run) {
    // SAFETY: as promised by the caller
    drop(unsafe { Box::from_raw(run) });
}

/// Number of positions and velocities.
///
/// # Safety
/// `run` came from [`foreign_new`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_size(run: *const Run) -> c_int {
    // SAFETY: as promised by the caller
    unsafe { &*run }.size() as c_int
}

/// Time of the start and u there.
///
/// # Safety
/// `run` came from [`foreign_new`]; `u` has room for its size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_start(run: *const Run, u: *mut f64) -> f64 {
    // SAFETY: as promised by the caller
    let run = unsafe { &*run };
    let n = run.size() / 2;
    let state = run.start.state();
    for (i, y) in state.q[..n].iter().chain(&state.v[..n]).enumerate() {
        // SAFETY: within the size
        unsafe { *u.add(i) = y / run.magnitudes[i] };
    }
    state.time()
}

/// Calls of right-hand side and Jacobian since the last call of this function.
///
/// # Safety
/// `run` came from [`foreign_new`]; `counts` has room for two.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_counts(run: *mut Run, counts: *mut u64) {
    // SAFETY: as promised by the caller
    let run = unsafe { &mut *run };
    // SAFETY: room for two
    unsafe {
        *counts = std::mem::take(&mut run.calls);
        *counts.add(1) = std::mem::take(&mut run.jacobians);
    }
}

/// Writes the last message to `text`.
///
/// # Safety
/// `run` came from [`foreign_new`]; `text` has room for `room` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_message(run: *const Run, text: *mut c_char, room: usize) {
    // SAFETY: as promised by the caller
    unsafe { write(&(*run).message, text, room) };
}

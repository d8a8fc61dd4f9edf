//! The program's own methods on the same run.

use std::ffi::c_int;

use crate::boundary::guarded;
use crate::run::{OUTPUTS, Run, outputs};

/// Reserves memory for `count` times, outside the timed part.
///
/// # Safety
/// `run` came from [`foreign_new`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_prepare(run: *mut Run, count: usize) {
    guarded(|| {
        // SAFETY: as promised by the caller
        let run = unsafe { &mut *run };
        run.reached.clear();
        run.reached.reserve(count + 1);
        0
    });
}

/// The program's own method to each of `count` times; 0 if it came to the last.
///
/// # Safety
/// `run` came from [`foreign_new`]; there are `count` times.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_own(run: *mut Run, times: *const f64, count: usize) -> c_int {
    guarded(|| {
        // SAFETY: as promised by the caller
        let (run, times) = unsafe { (&mut *run, std::slice::from_raw_parts(times, count)) };
        let mut simulation = run.start.clone();
        for &time in times {
            if let Err(failure) = simulation.advance(time) {
                run.message = failure.message;
                return 1;
            }
            run.reached.push(simulation.clone());
        }
        0
    })
}

/// Outputs at the times that the program's own method reached; returns how many there are. Its account is the message.
///
/// # Safety
/// `run` came from [`foreign_new`]; `out` has room for [`OUTPUTS`] numbers for each requested time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_reached(run: *mut Run, out: *mut f64) -> c_int {
    guarded(|| {
        // SAFETY: as promised by the caller
        let run = unsafe { &mut *run };
        for (k, simulation) in run.reached.iter_mut().enumerate() {
            // SAFETY: as promised by the caller
            unsafe { std::ptr::copy_nonoverlapping(outputs(simulation).as_ptr(), out.add(k * OUTPUTS), OUTPUTS) };
        }
        if let Some(last) = run.reached.last() {
            let statistics = last.state().statistics;
            (run.calls, run.jacobians) = (statistics.evaluations, statistics.jacobians);
            run.message = last.account();
        }
        run.reached.len() as c_int
    })
}

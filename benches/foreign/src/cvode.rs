//! Callbacks of CVODE (SUNDIALS), and a loop over its steps.

use std::ffi::{c_int, c_void};

use crate::run::{Entries, Run};

/// `int CVode(void *mem, double tout, N_Vector y, double *t, int task)`.
type Cvode = unsafe extern "C" fn(*mut c_void, f64, *mut c_void, *mut f64, c_int) -> c_int;

/// CV_NORMAL: step past the requested time and interpolate.
const NORMAL: c_int = 1;

/// Sets the access to the entries of SUNDIALS' vectors and dense matrices.
#[unsafe(no_mangle)]
pub extern "C" fn foreign_sundials(run: &mut Run, entries: Entries, data: Entries) {
    run.entries = Some([entries, data]);
}

/// CVODE's `CVRhsFn`.
///
/// # Safety
/// CVODE passes vectors of the run's size. [`foreign_sundials`] was called for `run` before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_cvode_rhs(_time: f64, u: *mut c_void, rate: *mut c_void, run: &mut Run) -> c_int {
    let Some([entries, _]) = run.entries else { return -1 };
    // SAFETY: guaranteed by the caller
    unsafe { run.rates(entries(u), entries(rate)) };
    0
}

/// CVODE's `CVLsJacFn` for dense matrices.
///
/// # Safety
/// The requirements of [`foreign_cvode_rhs`], and `matrix` is dense and has the run's size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_cvode_jacobian(
    _time: f64,
    u: *mut c_void,
    _rate: *mut c_void,
    matrix: *mut c_void,
    run: &mut Run,
    _spare: *mut c_void,
    _another: *mut c_void,
    _third: *mut c_void,
) -> c_int {
    let Some([entries, data]) = run.entries else { return -1 };
    // SAFETY: guaranteed by the caller
    unsafe { run.jacobian(entries(u), true, data(matrix)) };
    0
}

/// Steps CVODE to each of `count` times and copies its u to `out`. Returns the first error, or 0.
///
/// # Safety
/// `step` is the function `CVode`, `memory` is its memory, and `vector` has the run's size. `times` contains `count`
/// times, and `out` has room for `count` states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_cvode(
    run: *const Run,
    step: Cvode,
    memory: *mut c_void,
    vector: *mut c_void,
    times: *const f64,
    count: usize,
    out: *mut f64,
) -> c_int {
    // SAFETY: guaranteed by the caller; CVODE uses the run through its own pointer, so no reference to it is held here
    unsafe {
        let (size, Some([entries, _])) = ((*run).size(), (*run).entries) else { return -1 };
        let mut reached = 0.0;
        for k in 0..count {
            let status = step(memory, *times.add(k), vector, &mut reached, NORMAL);
            if status < 0 {
                return status;
            }
            std::ptr::copy_nonoverlapping(entries(vector), out.add(k * size), size);
        }
    }
    0
}

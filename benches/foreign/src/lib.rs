//! The equations of motion behind C functions, so that solvers written by others can integrate them without anything
//! but compiled code in their loops: plain right-hand side, CVODE's callbacks, and this program's own methods beside.
//!
//! Solvers see u = y / magnitude with y = (q, v), so that one absolute tolerance means the same for every component.
//! A run switches nothing, as none of the cases has dry friction. It is autonomous, but for those driven from outside.

use std::ffi::{CStr, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};

use bevel_differential::model::Simulation;

mod cases;
mod driven;

/// Largest number of positions and velocities of the cases.
const MOST: usize = 16;
/// Outputs of a state: speeds of the side gears, normal forces of the meshes of one planet, torques of the half-shafts.
const OUTPUTS: usize = 6;

/// `double *N_VGetArrayPointer(N_Vector)` of SUNDIALS.
type Entries = unsafe extern "C" fn(*mut c_void) -> *mut f64;
/// `double *SUNDenseMatrix_Data(SUNMatrix)`.
type MatrixData = unsafe extern "C" fn(*mut c_void) -> *mut f64;
/// `int CVode(void *mem, double tout, N_Vector y, double *t, int task)`.
type Cvode = unsafe extern "C" fn(*mut c_void, f64, *mut c_void, *mut f64, c_int) -> c_int;

/// CV_NORMAL: step past the time asked for and interpolate.
const NORMAL: c_int = 1;

/// A run with what solvers need of it.
pub struct Run {
    start: Simulation,
    magnitudes: Vec<f64>,
    /// Reached at the times asked for, by the program's own method.
    reached: Vec<Simulation>,
    /// How to get at the numbers in a vector and in a matrix of SUNDIALS.
    entries: Option<Entries>,
    data: Option<MatrixData>,
    calls: u64,
    jacobians: u64,
    message: String,
}

impl Run {
    fn size(&self) -> usize {
        self.magnitudes.len()
    }

    /// Rates of u.
    fn rates(&mut self, u: &[f64], rate: &mut [f64]) {
        let (size, n) = (self.size(), self.size() / 2);
        self.calls += 1;
        let mut y = [0.0; MOST];
        for i in 0..size {
            y[i] = u[i] * self.magnitudes[i];
        }
        let (dq, dv) = rate.split_at_mut(n);
        self.start.rates(&y[..n], &y[n..size], [dq, dv]);
        for i in 0..size {
            rate[i] /= self.magnitudes[i];
        }
    }

    /// ∂(rates of u)/∂u, row by row, or column by column.
    fn jacobian(&mut self, u: &[f64], by_column: bool, out: &mut [f64]) {
        let (size, n) = (self.size(), self.size() / 2);
        self.jacobians += 1;
        let mut y = [0.0; MOST];
        for i in 0..size {
            y[i] = u[i] * self.magnitudes[i];
        }
        let mut rows = [0.0; MOST * MOST];
        self.start.slopes(&y[..n], &y[n..size], &mut rows[..size * size]);
        for i in 0..size {
            for j in 0..size {
                let place = if by_column { j * size + i } else { i * size + j };
                out[place] = rows[i * size + j] * self.magnitudes[j] / self.magnitudes[i];
            }
        }
    }
}

fn outputs(simulation: &mut Simulation) -> [f64; OUTPUTS] {
    let [left, right] = simulation.motion().side_speed;
    let forces = simulation.forces();
    let [normal_left, normal_right] = forces.mesh[0].map(|mesh| mesh.normal);
    let [torque_left, torque_right] = forces.shaft_torque;
    [left, right, normal_left, normal_right, torque_left, torque_right]
}

/// Nothing unwinds into C.
fn guarded(work: impl FnOnce() -> c_int) -> c_int {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or(-1)
}

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

/// A case on the heap, for the caller to hold.
fn boxed(case: cases::Case) -> *mut Run {
    Box::into_raw(Box::new(Run {
        start: case.start,
        magnitudes: case.magnitudes,
        reached: Vec::new(),
        entries: None,
        data: None,
        calls: 0,
        jacobians: 0,
        message: String::new(),
    }))
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
    state.time
}

/// Calls of right-hand side and Jacobian since the last time this was asked.
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

/// The right-hand side: rates of u.
///
/// # Safety
/// `run` came from [`foreign_new`]; the arrays have its size and do not overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_rhs(_time: f64, u: *const f64, rate: *mut f64, run: *mut Run) {
    guarded(|| {
        // SAFETY: as promised by the caller
        unsafe {
            let run = &mut *run;
            let size = run.size();
            run.rates(std::slice::from_raw_parts(u, size), std::slice::from_raw_parts_mut(rate, size));
        }
        0
    });
}

/// The right-hand side's Jacobian, row by row.
///
/// # Safety
/// As of [`foreign_rhs`], with size² numbers in `rows`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_jacobian(_time: f64, u: *const f64, rows: *mut f64, run: *mut Run) {
    guarded(|| {
        // SAFETY: as promised by the caller
        unsafe {
            let run = &mut *run;
            let size = run.size();
            run.jacobian(std::slice::from_raw_parts(u, size), false, std::slice::from_raw_parts_mut(rows, size * size));
        }
        0
    });
}

/// Outputs at u.
///
/// # Safety
/// As of [`foreign_rhs`], with room for [`OUTPUTS`] numbers in `out`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_outputs(run: *const Run, u: *const f64, out: *mut f64) {
    guarded(|| {
        // SAFETY: as promised by the caller
        let (run, out) = unsafe { (&*run, std::slice::from_raw_parts_mut(out, OUTPUTS)) };
        let n = run.size() / 2;
        // SAFETY: within the size
        let y: Vec<f64> = run.magnitudes.iter().enumerate().map(|(i, m)| m * unsafe { *u.add(i) }).collect();
        out.copy_from_slice(&outputs(&mut run.start.moved(&y[..n], &y[n..])));
        0
    });
}

/// Tells how to get at the numbers in SUNDIALS' vectors and dense matrices.
///
/// # Safety
/// `run` came from [`foreign_new`]; the functions are those of SUNDIALS.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_sundials(run: *mut Run, entries: Entries, data: MatrixData) {
    // SAFETY: as promised by the caller
    let run = unsafe { &mut *run };
    (run.entries, run.data) = (Some(entries), Some(data));
}

/// CVODE's `CVRhsFn`.
///
/// # Safety
/// Called by CVODE with vectors of the run's size; `user` is the run, told how to get at them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_cvode_rhs(_time: f64, u: *mut c_void, rate: *mut c_void, user: *mut c_void) -> c_int {
    guarded(|| {
        // SAFETY: as promised by the caller
        unsafe {
            let run = &mut *user.cast::<Run>();
            let (size, Some(entries)) = (run.size(), run.entries) else { return -1 };
            let (u, rate) = (entries(u), entries(rate));
            run.rates(std::slice::from_raw_parts(u, size), std::slice::from_raw_parts_mut(rate, size));
        }
        0
    })
}

/// CVODE's `CVLsJacFn` for dense matrices.
///
/// # Safety
/// As of [`foreign_cvode_rhs`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_cvode_jacobian(
    _time: f64,
    u: *mut c_void,
    _rate: *mut c_void,
    matrix: *mut c_void,
    user: *mut c_void,
    _spare: *mut c_void,
    _another: *mut c_void,
    _third: *mut c_void,
) -> c_int {
    guarded(|| {
        // SAFETY: as promised by the caller
        unsafe {
            let run = &mut *user.cast::<Run>();
            let (size, Some(entries), Some(data)) = (run.size(), run.entries, run.data) else { return -1 };
            let (u, matrix) = (entries(u), data(matrix));
            run.jacobian(
                std::slice::from_raw_parts(u, size),
                true,
                std::slice::from_raw_parts_mut(matrix, size * size),
            );
        }
        0
    })
}

/// Lets CVODE step to each of `count` times and copies u there to `out`; its first error, or 0.
///
/// # Safety
/// `step` is `CVode`, `memory` what it works on, `vector` has the run's size; the arrays have room for what is told.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_cvode(
    run: *mut Run,
    step: Cvode,
    memory: *mut c_void,
    vector: *mut c_void,
    times: *const f64,
    count: usize,
    out: *mut f64,
) -> c_int {
    guarded(|| {
        // SAFETY: as promised by the caller; CVODE uses the run by its own pointer, so none is held here meanwhile
        unsafe {
            let (size, Some(entries)) = ((*run).magnitudes.len(), (*run).entries) else { return -1 };
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
    })
}

/// Makes room for `count` times, which is not to be paid for while the clock runs.
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
/// `run` came from [`foreign_new`]; `out` has room for [`OUTPUTS`] numbers for each time asked for.
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

/// Writes the last message to `text`.
///
/// # Safety
/// `run` came from [`foreign_new`]; `text` has room for `room` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_message(run: *const Run, text: *mut c_char, room: usize) {
    // SAFETY: as promised by the caller
    unsafe { write(&(*run).message, text, room) };
}

/// # Safety
/// `to` has room for `room` bytes.
unsafe fn write(text: &str, to: *mut c_char, room: usize) {
    let Some(most) = room.checked_sub(1) else { return };
    let length = text.len().min(most);
    // SAFETY: as promised by the caller
    unsafe {
        std::ptr::copy_nonoverlapping(text.as_ptr().cast(), to, length);
        *to.add(length) = 0;
    }
}

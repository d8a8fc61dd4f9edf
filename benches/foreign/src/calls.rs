//! C functions: creation of a run, its equations, and the program's own methods.

use std::ffi::{CStr, CString, c_char, c_int};

use bevel_differential::model::Inputs;
use cpu_time::ThreadTime;

use crate::run::{Outputs, Run, outputs};

/// Creates a run, see [`Run::new`]. If that fails, returns null and writes the reason to `problem`.
///
/// # Safety
/// `values` and `later` end with a zero byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_new(
    values: *const c_char,
    later: *const c_char,
    from: f64,
    problem: &mut *const c_char,
) -> Option<Box<Run>> {
    // SAFETY: guaranteed by the caller
    let [values, later] = [values, later].map(|text| unsafe { CStr::from_ptr(text) }.to_string_lossy());
    match Run::new(&values, &later, from) {
        Ok(run) => Some(Box::new(run)),
        Err(text) => {
            *problem = CString::new(text).unwrap_or_default().into_raw();
            None
        }
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn foreign_free(run: Box<Run>) {
    drop(run);
}

/// Number of positions and velocities.
#[unsafe(no_mangle)]
pub extern "C" fn foreign_size(run: &Run) -> c_int {
    run.size() as c_int
}

/// Sets the natural magnitudes of positions and velocities. They are 1 by default.
///
/// # Safety
/// `magnitudes` has the run's size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_scale(run: &mut Run, magnitudes: *const f64) {
    // SAFETY: guaranteed by the caller
    run.magnitudes = unsafe { std::slice::from_raw_parts(magnitudes, run.size()) }.to_vec();
}

/// Returns the time of the start [s], and writes the scaled unknowns u at the start.
///
/// # Safety
/// `u` has room for the run's size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_start(run: &Run, u: *mut f64) -> f64 {
    let n = run.size() / 2;
    let state = run.start.state();
    for (i, y) in state.q[..n].iter().chain(&state.v[..n]).enumerate() {
        // SAFETY: within the size
        unsafe { *u.add(i) = y / run.magnitudes[i] };
    }
    state.time()
}

/// Numbers of evaluations of right-hand side and Jacobian since the last call of this function.
#[unsafe(no_mangle)]
pub extern "C" fn foreign_counts(run: &mut Run, counts: &mut [u64; 2]) {
    *counts = std::mem::take(&mut run.counts);
}

/// The last message.
#[unsafe(no_mangle)]
pub extern "C" fn foreign_message(run: &Run) -> *const c_char {
    run.message.as_ptr()
}

/// Sets the present inputs: torque on the carrier [N·m], speeds of both wheels [rad/s].
#[unsafe(no_mangle)]
pub extern "C" fn foreign_drive(run: &mut Run, carrier_torque: f64, left_speed: f64, right_speed: f64) {
    run.inputs = Inputs { carrier_torque, side_speed: [left_speed, right_speed], ..run.inputs };
    run.start.set_inputs(&run.inputs);
}

/// Inertias of carrier, a side gear and all planets about their own axes [kg·m²].
#[unsafe(no_mangle)]
pub extern "C" fn foreign_inertias(run: &Run, out: &mut [f64; 3]) {
    let inertias = run.start.inertias();
    *out = [inertias.carrier, inertias.side[0], inertias.planets * inertias.planet];
}

/// Computes the right-hand side: the rates of the scaled unknowns u.
///
/// # Safety
/// The arrays have the run's size and do not overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_rhs(_time: f64, u: *const f64, rate: *mut f64, run: &mut Run) {
    // SAFETY: guaranteed by the caller
    unsafe { run.rates(u, rate) };
}

/// Computes the Jacobian of the right-hand side, row by row.
///
/// # Safety
/// Like [`foreign_rhs`], with size² numbers in `rows`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_jacobian(_time: f64, u: *const f64, rows: *mut f64, run: &mut Run) {
    // SAFETY: guaranteed by the caller
    unsafe { run.jacobian(u, false, rows) };
}

/// Computes the outputs at the scaled unknowns u.
///
/// # Safety
/// `u` has the run's size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_outputs(run: &Run, u: *const f64, out: &mut Outputs) {
    // SAFETY: guaranteed by the caller
    let (y, n) = (unsafe { run.place(u) }, run.size() / 2);
    *out = outputs(&mut run.start.moved(&y[..n], &y[n..]));
}

/// Runs the program's own method to each of `count` times. Writes the CPU time [s] and the outputs at the times that
/// were reached; its statistics become the message. Returns 0 if it reached the last time.
///
/// # Safety
/// There are `count` times, and room for `count` outputs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_own(
    run: &mut Run,
    times: *const f64,
    count: usize,
    out: *mut Outputs,
    cost: &mut f64,
) -> c_int {
    // SAFETY: guaranteed by the caller
    let times = unsafe { std::slice::from_raw_parts(times, count) };
    let mut reached = Vec::with_capacity(count);
    let begin = ThreadTime::now();
    let mut simulation = run.start.clone();
    let mut failed = None;
    for &time in times {
        if let Err(failure) = simulation.advance(time) {
            failed = Some(failure.message);
            break;
        }
        reached.push(simulation.clone());
    }
    *cost = begin.elapsed().as_secs_f64();
    for (k, simulation) in reached.iter_mut().enumerate() {
        // SAFETY: guaranteed by the caller
        unsafe { *out.add(k) = outputs(simulation) };
    }
    let statistics = simulation.state().statistics;
    run.counts = [statistics.evaluations, statistics.jacobians];
    let status = c_int::from(failed.is_some());
    run.message = CString::new(failed.unwrap_or_else(|| simulation.account())).unwrap_or_default();
    status
}

//! The C functions: making a run, its equations, and the program's own methods on it.

use std::ffi::{CStr, CString, c_char, c_int};

use bevel_differential::model::Inputs;
use cpu_time::ThreadTime;

use crate::run::{Outputs, Run, outputs};

/// Makes a run, see [`Run::new`]; null, with the reason in `problem`, if there is none such.
///
/// # Safety
/// `values` and `later` end with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_new(
    values: *const c_char,
    later: *const c_char,
    from: f64,
    problem: &mut *const c_char,
) -> Option<Box<Run>> {
    // SAFETY: as promised by the caller
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

/// Sets the natural magnitudes of positions and velocities, which are 1 otherwise.
///
/// # Safety
/// `magnitudes` has the run's size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_scale(run: &mut Run, magnitudes: *const f64) {
    // SAFETY: as promised by the caller
    run.magnitudes = unsafe { std::slice::from_raw_parts(magnitudes, run.size()) }.to_vec();
}

/// Time of the start and u there.
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

/// Calls of right-hand side and Jacobian since the last call of this function.
#[unsafe(no_mangle)]
pub extern "C" fn foreign_counts(run: &mut Run, counts: &mut [u64; 2]) {
    *counts = std::mem::take(&mut run.counts);
}

/// The last message.
#[unsafe(no_mangle)]
pub extern "C" fn foreign_message(run: &Run) -> *const c_char {
    run.message.as_ptr()
}

/// Sets the inputs that act from now on: torque on the carrier [N·m], speeds of both wheels [rad/s].
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

/// The right-hand side: rates of u.
///
/// # Safety
/// The arrays have the run's size and do not overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_rhs(_time: f64, u: *const f64, rate: *mut f64, run: &mut Run) {
    // SAFETY: as promised by the caller
    unsafe { run.rates(u, rate) };
}

/// The right-hand side's Jacobian, row by row.
///
/// # Safety
/// As of [`foreign_rhs`], with size² numbers in `rows`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_jacobian(_time: f64, u: *const f64, rows: *mut f64, run: &mut Run) {
    // SAFETY: as promised by the caller
    unsafe { run.jacobian(u, false, rows) };
}

/// Outputs at u.
///
/// # Safety
/// `u` has the run's size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_outputs(run: &Run, u: *const f64, out: &mut Outputs) {
    // SAFETY: as promised by the caller
    let (y, n) = (unsafe { run.place(u) }, run.size() / 2);
    *out = outputs(&mut run.start.moved(&y[..n], &y[n..]));
}

/// The program's own method to each of `count` times, with the CPU time that it took [s] and outputs at the times that it reached;
/// 0 if it came to the last. Its account is the message.
///
/// # Safety
/// There are `count` times, and room for as many outputs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_own(
    run: &mut Run,
    times: *const f64,
    count: usize,
    out: *mut Outputs,
    cost: &mut f64,
) -> c_int {
    // SAFETY: as promised by the caller
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
        // SAFETY: as promised by the caller
        unsafe { *out.add(k) = outputs(simulation) };
    }
    let statistics = simulation.state().statistics;
    run.counts = [statistics.evaluations, statistics.jacobians];
    let status = c_int::from(failed.is_some());
    run.message = CString::new(failed.unwrap_or_else(|| simulation.account())).unwrap_or_default();
    status
}

//! Right-hand side, Jacobian and outputs on plain arrays.

use crate::boundary::guarded;
use crate::run::{OUTPUTS, Run, outputs};

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

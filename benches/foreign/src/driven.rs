//! The equations within a larger system: inputs may change at every evaluation, and parameters come by name.

use std::ffi::{CStr, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use bevel_differential::model::{Inputs, Parameters, Simulation};
use bevel_differential::problem;
use bevel_differential::variables::{assign, named};

use crate::boundary::write;
use crate::cases::Case;
use crate::run::{Run, boxed};

/// A run with the parameters in `values`, lines of a variable's name and a number (of an enumeration its literal's).
fn case(values: &str) -> Result<Case, String> {
    let mut p = Parameters::default();
    for line in values.lines() {
        let parsed = line.split_once(' ').and_then(|(name, value)| Some((name, value.parse::<f64>().ok()?)));
        let (name, value) = parsed.ok_or_else(|| format!("\"{line}\" is not a name and a number"))?;
        let row = named(name).ok_or_else(|| format!("there is no parameter {name}"))?;
        assign(row, value, &mut p, &mut Inputs::default()).map_err(|problem| problem.to_string())?;
    }
    let start = Simulation::start(&p, &still(), 0.0).map_err(|problems| problem::list(&problems))?;
    Ok(Case { magnitudes: vec![1.0; 2 * start.freedoms()], start })
}

/// Nothing drives and nothing turns.
fn still() -> Inputs {
    Inputs { carrier_speed: 0.0, carrier_torque: 0.0, load_torque: [0.0; 2], side_speed: [0.0; 2], ..Inputs::default() }
}

/// Makes a run of the parameters in `values`, without inputs; null, with the reason in `problem`, if there is none such.
///
/// # Safety
/// `values` ends with a zero; `problem` has room for `room` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_driven(values: *const c_char, problem: *mut c_char, room: usize) -> *mut Run {
    // SAFETY: as promised by the caller
    let values = unsafe { CStr::from_ptr(values) }.to_string_lossy().into_owned();
    let made = catch_unwind(|| case(&values)).unwrap_or_else(|_| Err("panicked".to_owned()));
    match made {
        Ok(case) => boxed(case),
        Err(text) => {
            // SAFETY: as promised by the caller
            unsafe { write(&text, problem, room) };
            std::ptr::null_mut()
        }
    }
}

/// Sets the inputs that act from now on: torque on the carrier [N·m], speeds of both wheels [rad/s].
///
/// # Safety
/// `run` came from [`foreign_driven`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_drive(run: *mut Run, carrier_torque: f64, left_speed: f64, right_speed: f64) {
    // SAFETY: as promised by the caller
    let run = unsafe { &mut *run };
    // whatever unwinds leaves inputs as they were
    let _ = catch_unwind(AssertUnwindSafe(|| {
        run.start.set_inputs(&Inputs { carrier_torque, side_speed: [left_speed, right_speed], ..still() });
    }));
}

/// Inertias of carrier, a side gear and all planets about their own axes [kg·m²].
///
/// # Safety
/// `run` came from [`foreign_driven`]; `out` has room for three numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn foreign_inertias(run: *const Run, out: *mut f64) {
    // SAFETY: as promised by the caller
    let inertias = unsafe { &*run }.start.inertias();
    let values = [inertias.carrier, inertias.side[0], inertias.planets * inertias.planet];
    // SAFETY: room for three
    unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), out, values.len()) };
}

//! A run with its equations in scaled unknowns, and the outputs of states.

use std::ffi::{CString, c_void};

use bevel_differential::integrate::{Control, Statistics};
use bevel_differential::model::{Inputs, Parameters, Simulation};
use bevel_differential::problem::{self, Problem};
use bevel_differential::variables::{assign, named, number_of};

/// Maximum number of positions and velocities of the cases.
const MOST: usize = 16;
/// First trial step of this program's methods, as after any start [s].
const FIRST_STEP: f64 = 1e-6;

/// Outputs: speeds of the side gears, normal forces of the meshes of one planet, torques of the half-shafts.
pub type Outputs = [f64; 6];
/// `double *N_VGetArrayPointer(N_Vector)` and `double *SUNDenseMatrix_Data(SUNMatrix)` of SUNDIALS.
pub type Entries = unsafe extern "C" fn(*mut c_void) -> *mut f64;

/// A run with the data that solvers need.
pub struct Run {
    /// Simulation at the start of the run.
    pub start: Simulation,
    /// Present inputs.
    pub inputs: Inputs,
    /// Natural magnitudes of positions and velocities.
    pub magnitudes: Vec<f64>,
    /// Access to the entries of SUNDIALS' vectors and matrices; `None` until `foreign_sundials` is called.
    pub entries: Option<[Entries; 2]>,
    /// Numbers of evaluations of the right-hand side and of the Jacobian since the last reading.
    pub counts: [u64; 2],
    /// Last message for the caller.
    pub message: CString,
}

impl Run {
    /// Creates a run from the start with `values`, or from the time `from` of the change to the `later` values. Both
    /// texts have lines with the name of a variable and a number, or the name of a choice.
    pub fn new(values: &str, later: &str, from: f64) -> Result<Self, String> {
        let listed = |problems: Vec<Problem>| problem::list(&problems);
        let (mut p, mut inputs) = (Parameters::default(), Inputs::default());
        assign_all(values, &mut p, &mut inputs)?;
        let mut start = Simulation::start(&p, &inputs, 0.0).map_err(listed)?;
        if from > 0.0 {
            start.advance(from).map_err(|failure| failure.message)?;
            let mut state = *start.state();
            (state.control, state.statistics) = (Control::new(FIRST_STEP), Statistics::default());
            assign_all(later, &mut p, &mut inputs)?;
            start = Simulation::resume(&p, &inputs, state).map_err(listed)?;
        }
        let magnitudes = vec![1.0; 2 * start.degrees_of_freedom()];
        Ok(Self { start, inputs, magnitudes, entries: None, counts: [0; 2], message: CString::default() })
    }

    /// Number of positions and velocities.
    pub fn size(&self) -> usize {
        self.magnitudes.len()
    }

    /// Positions and velocities at `u`.
    ///
    /// # Safety
    /// `u` has the run's size.
    pub unsafe fn place(&self, u: *const f64) -> [f64; MOST] {
        let mut y = [0.0; MOST];
        for (i, magnitude) in self.magnitudes.iter().enumerate() {
            // SAFETY: guaranteed by the caller
            y[i] = unsafe { *u.add(i) } * magnitude;
        }
        y
    }

    /// Rates of u.
    ///
    /// # Safety
    /// `u` and `rate` have the run's size and do not overlap.
    pub unsafe fn rates(&mut self, u: *const f64, rate: *mut f64) {
        let (size, n) = (self.size(), self.size() / 2);
        self.counts[0] += 1;
        // SAFETY: guaranteed by the caller
        let (y, rate) = unsafe { (self.place(u), std::slice::from_raw_parts_mut(rate, size)) };
        let (dq, dv) = rate.split_at_mut(n);
        self.start.rates(&y[..n], &y[n..size], [dq, dv]);
        for i in 0..size {
            rate[i] /= self.magnitudes[i];
        }
    }

    /// ∂(rates of u)/∂u, row by row, or column by column if `by_column`.
    ///
    /// # Safety
    /// `u` has the run's size, `out` its square.
    pub unsafe fn jacobian(&mut self, u: *const f64, by_column: bool, out: *mut f64) {
        let (size, n) = (self.size(), self.size() / 2);
        self.counts[1] += 1;
        // SAFETY: guaranteed by the caller
        let (y, out) = unsafe { (self.place(u), std::slice::from_raw_parts_mut(out, size * size)) };
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

fn assign_all(values: &str, p: &mut Parameters, i: &mut Inputs) -> Result<(), String> {
    for line in values.lines() {
        let (name, text) = line.split_once(' ').ok_or_else(|| format!("\"{line}\" is not a name and a value"))?;
        let row = named(name).ok_or_else(|| format!("there is no variable {name}"))?;
        let value = text.parse().or_else(|_| number_of(row, text));
        value.and_then(|value| assign(row, value, p, i)).map_err(|problem| problem.to_string())?;
    }
    Ok(())
}

/// Outputs of a state.
pub fn outputs(simulation: &mut Simulation) -> Outputs {
    let [left, right] = simulation.motion().side_speed;
    let forces = simulation.forces();
    let [normal_left, normal_right] = forces.mesh[0].map(|mesh| mesh.normal);
    let [torque_left, torque_right] = forces.shaft_torque;
    [left, right, normal_left, normal_right, torque_left, torque_right]
}

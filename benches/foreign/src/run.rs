//! A run with its equations in scaled unknowns, and the outputs of its states.

use std::ffi::c_void;

use bevel_differential::model::Simulation;

use crate::cases::Case;

/// Largest number of positions and velocities of the cases.
const MOST: usize = 16;
/// Outputs of a state: speeds of the side gears, normal forces of the meshes of one planet, torques of the half-shafts.
pub const OUTPUTS: usize = 6;

/// `double *N_VGetArrayPointer(N_Vector)` of SUNDIALS.
pub type Entries = unsafe extern "C" fn(*mut c_void) -> *mut f64;
/// `double *SUNDenseMatrix_Data(SUNMatrix)`.
pub type MatrixData = unsafe extern "C" fn(*mut c_void) -> *mut f64;

/// A run with what solvers need of it.
pub struct Run {
    /// The run at its start.
    pub start: Simulation,
    /// Natural magnitudes of positions and velocities.
    pub magnitudes: Vec<f64>,
    /// States at the requested times, by the program's own method.
    pub reached: Vec<Simulation>,
    /// Access to the entries of SUNDIALS' vectors and matrices.
    pub entries: Option<Entries>,
    pub data: Option<MatrixData>,
    /// Evaluations of the right-hand side and of the Jacobian since they were last read.
    pub calls: u64,
    pub jacobians: u64,
    /// Last message to the caller.
    pub message: String,
}

impl Run {
    /// Number of positions and velocities.
    pub fn size(&self) -> usize {
        self.magnitudes.len()
    }

    /// Rates of u.
    pub fn rates(&mut self, u: &[f64], rate: &mut [f64]) {
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
    pub fn jacobian(&mut self, u: &[f64], by_column: bool, out: &mut [f64]) {
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

/// Outputs of a state.
pub fn outputs(simulation: &mut Simulation) -> [f64; OUTPUTS] {
    let [left, right] = simulation.motion().side_speed;
    let forces = simulation.forces();
    let [normal_left, normal_right] = forces.mesh[0].map(|mesh| mesh.normal);
    let [torque_left, torque_right] = forces.shaft_torque;
    [left, right, normal_left, normal_right, torque_left, torque_right]
}

/// A case on the heap, for the caller to hold.
pub fn boxed(case: Case) -> *mut Run {
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

//! What an integrator needs to know of a mechanical system.

use serde::{Deserialize, Serialize};

/// Largest number of degrees of freedom: two side gears, the carrier, four planets.
pub const MAX_DOF: usize = 7;
/// Per degree of freedom; only the first `dof` entries are used.
pub type Vector = [f64; MAX_DOF];
/// Rows and columns per degree of freedom.
pub type Matrix = [[f64; MAX_DOF]; MAX_DOF];
/// The zero vector.
pub const ZERO: Vector = [0.0; MAX_DOF];

/// Positions and velocities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Positions q.
    pub q: Vector,
    /// Velocities v.
    pub v: Vector,
}

/// Rates of the energy ledger at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Power {
    /// Net power of all inputs into the system [W].
    pub input: f64,
    /// Power turned into heat [W].
    pub heat: f64,
}

/// Accelerations with their exact derivatives at a point.
#[derive(Clone, Copy, Debug, Default)]
pub struct Linearisation {
    /// v̇.
    pub acceleration: Vector,
    /// ∂v̇/∂q.
    pub by_position: Matrix,
    /// ∂v̇/∂v.
    pub by_velocity: Matrix,
    /// Ledger rates.
    pub power: Power,
}

/// An autonomous second-order system q̇ = B v, v̇ = a(q, v). Imposed motions are degrees of freedom with a given v̇.
pub trait SecondOrder {
    /// Number of degrees of freedom, at most [`MAX_DOF`].
    fn dof(&self) -> usize;

    /// B v.
    fn rates(&self, v: &Vector) -> Vector {
        *v
    }

    /// Replaces `m` by m B, row by row.
    fn times_rates(&self, _m: &mut Matrix) {}

    /// Accelerations and ledger rates.
    fn evaluate(&self, at: &Point, acceleration: &mut Vector) -> Power;

    /// Accelerations, ledger rates and exact derivatives; derivatives are added to a zeroed `out`.
    fn linearise(&self, at: &Point, out: &mut Linearisation);

    /// Natural magnitudes of q and v: the local error allowed is the relative tolerance times these.
    fn scales(&self, at: &Point) -> Point;
}

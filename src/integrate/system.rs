//! What an integrator needs to know of a mechanical system.

/// Rows and columns per degree of freedom.
pub type Matrix<const N: usize> = [[f64; N]; N];

/// Positions and velocities of `N` degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<const N: usize> {
    /// Positions q.
    pub q: [f64; N],
    /// Velocities v.
    pub v: [f64; N],
}

impl<const N: usize> Point<N> {
    /// All zero.
    pub const ZERO: Self = Self { q: [0.0; N], v: [0.0; N] };
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
#[derive(Clone, Copy, Debug)]
pub struct Linearisation<const N: usize> {
    /// v̇.
    pub acceleration: [f64; N],
    /// ∂v̇/∂q.
    pub by_position: Matrix<N>,
    /// ∂v̇/∂v.
    pub by_velocity: Matrix<N>,
    /// Ledger rates.
    pub power: Power,
}

/// An autonomous second-order system q̇ = B v, v̇ = a(q, v). Imposed motions are degrees of freedom with a given v̇.
///
/// Sizes are known at compile time: the loops of these small systems unroll, which makes them several times faster.
pub trait SecondOrder<const N: usize> {
    /// B v.
    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        *v
    }

    /// Replaces `m` by m B, row by row.
    fn times_rates(&self, _m: &mut Matrix<N>) {}

    /// Accelerations and ledger rates.
    fn evaluate(&self, at: &Point<N>) -> ([f64; N], Power);

    /// Accelerations, ledger rates and exact derivatives.
    fn linearise(&self, at: &Point<N>) -> Linearisation<N>;

    /// Reciprocals of the natural magnitudes of q and v: the error of a step, so weighted, must not exceed the tolerance.
    fn weights(&self, at: &Point<N>) -> Point<N>;
}

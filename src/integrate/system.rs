//! Interface of a mechanical system to the integrator.

use std::ops::Range;

/// Square matrix with a row and a column per degree of freedom.
pub type Matrix<const N: usize> = [[f64; N]; N];

/// Positions and velocities of `N` degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Point<const N: usize> {
    /// Positions q.
    pub q: [f64; N],
    /// Velocities v.
    pub v: [f64; N],
}

impl<const N: usize> Default for Point<N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const N: usize> Point<N> {
    /// All zero.
    pub const ZERO: Self = Self { q: [0.0; N], v: [0.0; N] };

    /// Creates a point from as many positions and velocities as fit; the others are zero.
    #[inline]
    pub fn of<const M: usize>([q, v]: [&[f64; M]; 2]) -> Self {
        let (mut point, n) = (Self::ZERO, N.min(M));
        point.q[..n].copy_from_slice(&q[..n]);
        point.v[..n].copy_from_slice(&v[..n]);
        point
    }

    /// Writes as many positions and velocities as fit.
    #[inline]
    pub fn write<const M: usize>(&self, [q, v]: [&mut [f64; M]; 2]) {
        let n = N.min(M);
        q[..n].copy_from_slice(&self.q[..n]);
        v[..n].copy_from_slice(&self.v[..n]);
    }

    /// Returns positions and velocities as one row, which fills vector registers better than two.
    #[inline]
    #[allow(unsafe_code)]
    pub fn row(&self) -> &[f64] {
        // SAFETY: two arrays of N numbers, one directly after the other (repr(C)).
        unsafe { std::slice::from_raw_parts(std::ptr::from_ref(self).cast(), 2 * N) }
    }

    /// Returns positions and velocities as one mutable row.
    #[inline]
    #[allow(unsafe_code)]
    pub fn row_mut(&mut self) -> &mut [f64] {
        // SAFETY: two arrays of N numbers, one directly after the other (repr(C)).
        unsafe { std::slice::from_raw_parts_mut(std::ptr::from_mut(self).cast(), 2 * N) }
    }
}

/// Relative rounding of positions at the end of a step.
pub const POSITION_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Energy of a step that the ledger cannot account for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imbalance {
    /// Residual of the energy balance, beyond the rounding of kinetic energy.
    pub residual: f64,
    /// Energy exchanged in the step.
    pub exchanged: f64,
}

impl Imbalance {
    /// Imbalance of a ledger that closes.
    pub const NONE: Self = Self { residual: 0.0, exchanged: 0.0 };

    /// Residual divided by the exchanged energy.
    #[inline]
    pub fn relative(&self) -> f64 {
        if self.residual > 0.0 { self.residual / self.exchanged.max(f64::MIN_POSITIVE) } else { 0.0 }
    }
}

/// A point at a time.
#[derive(Clone, Copy)]
pub struct TimedPoint<'a, const N: usize> {
    /// Positions and velocities.
    pub point: &'a Point<N>,
    /// Time [s].
    pub time: f64,
}

/// Accelerations with their exact derivatives at a point. It is large, so steps compute it in place.
#[derive(Clone, Copy, Debug)]
pub struct Linearisation<const N: usize, P> {
    /// v̇.
    pub acceleration: [f64; N],
    /// ∂v̇/∂q.
    pub by_position: Matrix<N>,
    /// ∂v̇/∂v.
    pub by_velocity: Matrix<N>,
    /// Ledger rates.
    pub ledger_rates: P,
}

impl<const N: usize, P: Default> Default for Linearisation<N, P> {
    #[inline]
    fn default() -> Self {
        let zero = [[0.0; N]; N];
        Self { acceleration: [0.0; N], by_position: zero, by_velocity: zero, ledger_rates: P::default() }
    }
}

/// A second-order system q̇ = B v, v̇ = a(q, v). Imposed motions are degrees of freedom with a given v̇.
///
/// A system may be driven, v̇ = a(q, v, t), with the time counted from the start of the integration. A system that is
/// not driven keeps the default functions of time, which cost nothing.
///
/// Sizes are known at compile time, so the loops of these small systems unroll, which makes them several times faster.
/// A system may be smaller than its type: rows from [`Self::degrees_of_freedom`] on are zero and stay zero.
pub trait SecondOrder<const N: usize> {
    /// Ledger rates: powers that are integrated along the motion but do not act on it.
    type Rates: Copy + Default;

    /// Number of degrees of freedom, at most `N`.
    #[inline]
    fn degrees_of_freedom(&self) -> usize {
        N
    }

    /// Number of rows of the linear systems, at least the number of degrees of freedom. Additional rows are zero and
    /// have no effect. A number known at compile time makes the code shorter and faster.
    #[inline]
    fn rows(&self) -> usize {
        self.degrees_of_freedom()
    }

    /// Range of the degrees of freedom that are weakly coupled to each other and eliminated first.
    #[inline]
    fn inner(&self) -> Range<usize> {
        N..N
    }

    /// Returns B v.
    #[inline]
    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        *v
    }

    /// Replaces `m` by m B, row by row.
    #[inline]
    fn times_rates(&self, _m: &mut Matrix<N>) {}

    /// Returns accelerations and ledger rates.
    fn evaluate(&self, at: &Point<N>) -> ([f64; N], Self::Rates);

    /// Returns accelerations, ledger rates and exact derivatives.
    fn linearise(&self, at: &Point<N>) -> Linearisation<N, Self::Rates>;

    /// True if accelerations depend on time as well.
    #[inline]
    fn is_driven(&self) -> bool {
        false
    }

    /// [`Self::evaluate`] of a driven system at `time` [s].
    #[inline]
    fn evaluate_at(&self, at: &Point<N>, _time: f64) -> ([f64; N], Self::Rates) {
        self.evaluate(at)
    }

    /// Accelerations only, for the stages of a step.
    #[inline]
    fn accelerate_at(&self, at: &Point<N>, time: f64) -> [f64; N] {
        self.evaluate_at(at, time).0
    }

    /// [`Self::linearise`] of a driven system at `time` [s].
    #[inline]
    fn linearise_at(&self, at: &Point<N>, _time: f64) -> Linearisation<N, Self::Rates> {
        self.linearise(at)
    }

    /// ∂v̇/∂t of a driven system at `time` [s].
    fn drift(&self, _at: &Point<N>, _time: f64) -> [f64; N] {
        [0.0; N]
    }

    /// Converts ledger rates at `at` to the rates before the torques changed. Does nothing if they did not change.
    #[inline]
    fn undo_torque_change(&self, _at: &Point<N>, _rates: &mut Self::Rates) {}

    /// Σ weight · rates over five points of a step. The default, for rates that are not used, returns those in the
    /// middle.
    fn combined(&self, of: [(f64, &Self::Rates); 5]) -> Self::Rates {
        *of[2].1
    }

    /// Reciprocals of the natural magnitudes of q and v. The error of a step, weighted with them, must not exceed the
    /// tolerance.
    fn weights(&self, at: &Point<N>) -> Point<N>;

    /// Kinetic and stored energy [J].
    #[inline]
    fn energy(&self, _at: &Point<N>) -> [f64; 2] {
        [0.0; 2]
    }

    /// Writes [`Self::linearise_at`] to `lin` and returns [`Self::energy`] at the same point, for systems that compute
    /// both at the same time.
    #[inline]
    fn linearise_with_energy(&self, at: &Point<N>, time: f64, lin: &mut Linearisation<N, Self::Rates>) -> [f64; 2] {
        *lin = self.linearise_at(at, time);
        self.energy(at)
    }

    /// Imbalance of the ledger of a step of size `h` [s], from the energies at both ends and the ledger rates at start,
    /// middle and end.
    #[inline]
    fn imbalance(&self, _energies: [[f64; 2]; 2], _h: f64, _power: &[Self::Rates; 3]) -> Imbalance {
        Imbalance::NONE
    }

    /// Energy that the ledger of a step between `ends` does not resolve if the motion has the relative `tolerance`. The
    /// step is accepted if the `residual` of the ledger is smaller, so a result below `residual` need not be exact. The
    /// floor is evaluated only if the ledger does not close otherwise.
    fn energy_floor(&self, _ends: [&Point<N>; 2], _tolerance: f64, _residual: f64) -> f64 {
        0.0
    }

    /// Fraction of an iteration from `from` to `to` that may be applied without jumping deep into a contact whose force
    /// is not evaluated yet.
    #[inline]
    fn safe_fraction(&self, _from: &Point<N>, _to: &Point<N>) -> f64 {
        1.0
    }

    /// Fraction of a step of size `h` [s] at which the first kink of the accelerations is predicted from the state
    /// `at`. The step is shortened to this fraction. Returns `None` if no kink is predicted.
    #[inline]
    fn kink(&self, _at: &Point<N>, _h: f64) -> Option<f64> {
        None
    }

    /// Fraction of the step from `start` to `end` to which it must be shortened because a switch of the equations is
    /// within it. Returns `None` without such a switch, or if the switch is already close enough to the end.
    #[inline]
    fn crossing(&self, _start: TimedPoint<N>, _end: TimedPoint<N>) -> Option<f64> {
        None
    }
}

//! Problems with known solutions.

use bevel_differential::integrate::{Linearisation, Matrix, Point, SecondOrder};

/// Acceleration with its derivatives with respect to positions and velocities.
pub type Jet<const N: usize> = ([f64; N], Matrix<N>, Matrix<N>);

/// A system defined by its acceleration and the derivatives of the acceleration, with the magnitudes of its motion.
pub struct System<F, const N: usize> {
    pub acceleration: F,
    pub magnitude: Point<N>,
}

impl<const N: usize, F: Fn(&Point<N>) -> Jet<N>> SecondOrder<N> for System<F, N> {
    type Rates = ();

    fn evaluate(&self, at: &Point<N>) -> ([f64; N], ()) {
        ((self.acceleration)(at).0, ())
    }

    fn linearise(&self, at: &Point<N>) -> Linearisation<N, ()> {
        let (acceleration, by_position, by_velocity) = (self.acceleration)(at);
        Linearisation { acceleration, by_position, by_velocity, ledger_rates: () }
    }

    fn weights(&self, _: &Point<N>) -> Point<N> {
        Point { q: self.magnitude.q.map(|x| 1.0 / x), v: self.magnitude.v.map(|x| 1.0 / x) }
    }
}

/// Creates a system with magnitudes near one.
pub fn system<const N: usize, F: Fn(&Point<N>) -> Jet<N>>(acceleration: F) -> System<F, N> {
    System { acceleration, magnitude: Point { q: [1.0; N], v: [1.0; N] } }
}

/// Two damped oscillators x″ + 2ζx′ + ω²x = 0, transformed by y = eˣ: y″ = y′²/y − 2ζy′ − ω²y ln y, which is nonlinear
/// in positions and velocities to all orders. They are mixed by q = P y, with q̇ = B v.
pub struct Logarithmic;

/// ω² and ζ.
const OSCILLATORS: [[f64; 2]; 2] = [[1.0, 0.1], [2.3, 0.25]];
const P: Matrix<2> = [[1.0, 0.3], [-0.2, 1.0]];
const B: Matrix<2> = [[1.2, 0.0], [-0.4, 0.8]];

fn times<const N: usize>(m: &Matrix<N>, x: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| (0..N).map(|j| m[i][j] * x[j]).sum())
}

fn product(a: &Matrix<2>, b: &Matrix<2>) -> Matrix<2> {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

fn inverse(m: &Matrix<2>) -> Matrix<2> {
    let d = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    [[m[1][1] / d, -m[0][1] / d], [-m[1][0] / d, m[0][0] / d]]
}

impl Logarithmic {
    /// Returns the exact motion at time `t`.
    pub fn exact(t: f64) -> Point<2> {
        let motion = OSCILLATORS.map(|[square, zeta]| {
            let (x0, v0) = (0.7, 0.3);
            let (w, decay) = ((square - zeta * zeta).sqrt(), (-zeta * t).exp());
            let (sin, cos) = (w * t).sin_cos();
            let x = decay * (x0 * cos + (v0 + zeta * x0) / w * sin);
            let v = decay * (v0 * cos - (square * x0 + zeta * v0) / w * sin);
            [x.exp(), v * x.exp()]
        });
        let y = |k: usize| [motion[0][k], motion[1][k]];
        Point { q: times(&P, &y(0)), v: times(&inverse(&B), &times(&P, &y(1))) }
    }
}

impl SecondOrder<2> for Logarithmic {
    type Rates = f64;

    fn rates(&self, v: &[f64; 2]) -> [f64; 2] {
        times(&B, v)
    }

    fn times_rates(&self, m: &mut Matrix<2>) {
        *m = product(m, &B);
    }

    fn evaluate(&self, at: &Point<2>) -> ([f64; 2], f64) {
        let lin = self.linearise(at);
        (lin.acceleration, lin.ledger_rates)
    }

    fn linearise(&self, at: &Point<2>) -> Linearisation<2, f64> {
        let (from, to) = (product(&inverse(&B), &P), inverse(&P));
        let (y, rate) = (times(&to, &at.q), times(&to, &times(&B, &at.v)));
        let (mut force, mut by_y, mut by_rate) = ([0.0; 2], [[0.0; 2]; 2], [[0.0; 2]; 2]);
        for (i, [square, zeta]) in OSCILLATORS.into_iter().enumerate() {
            let (y, rate) = (y[i], rate[i]);
            force[i] = rate * rate / y - 2.0 * zeta * rate - square * y * y.ln();
            by_y[i][i] = -rate * rate / (y * y) - square * (y.ln() + 1.0);
            by_rate[i][i] = 2.0 * rate / y - 2.0 * zeta;
        }
        Linearisation {
            acceleration: times(&from, &force),
            by_position: product(&product(&from, &by_y), &to),
            by_velocity: product(&product(&from, &by_rate), &product(&to, &B)),
            ledger_rates: at.v[0] * at.q[1],
        }
    }

    fn weights(&self, _: &Point<2>) -> Point<2> {
        Point { q: [1.0; 2], v: [1.0; 2] }
    }
}

/// Prothero and Robinson's problem: v̇ = −λ (v − cos c) − sin c, with the clock ċ = 1 as an imposed motion. Its
/// solution for any λ is v = cos c and q = sin c.
pub fn forced(lambda: f64) -> System<impl Fn(&Point<2>) -> Jet<2>, 2> {
    system(move |p: &Point<2>| {
        let c = p.q[1];
        let acceleration = -lambda * (p.v[0] - c.cos()) - c.sin();
        let slope = -lambda * c.sin() - c.cos();
        ([acceleration, 0.0], [[0.0, slope], [0.0; 2]], [[-lambda, 0.0], [0.0; 2]])
    })
}

/// Exact motion of [`forced`].
pub fn forced_exact(t: f64) -> Point<2> {
    Point { q: [t.sin(), t], v: [t.cos(), 1.0] }
}

/// Largest difference of any component.
pub fn distance<const N: usize>(a: &Point<N>, b: &Point<N>) -> f64 {
    (0..N).map(|i| (a.q[i] - b.q[i]).abs().max((a.v[i] - b.v[i]).abs())).fold(0.0, f64::max)
}

//! RODAS: a Rosenbrock method of order 4 with embedded order 3, six stages, L-stable and stiffly accurate.
//!
//! E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section VI.4, in the
//! transformed variables U of section IV.7:
//!
//!   (I/hγ − J) U_i = f(y₀ + Σ a_ij U_j) + Σ c_ij U_j / h,   y₁ = y₀ + Σ a_5j U_j + U₅ + U₆,   error = U₆
//!
//! With y = (q, v), q̇ = B v and K = ∂v̇/∂q, D = ∂v̇/∂v, the q-rows are solved by hand, so that the matrix to factorise
//! has the order of the velocities alone:
//!
//!   (I/s − D − s K B) U_v = r_v + s K r_q,   U_q = s (r_q + B U_v),   s = hγ.
//!
//! Every system here is autonomous (imposed motions are degrees of freedom), so that no ∂f/∂t appears.

use super::linear::Lu;
use super::system::{Linearisation, Point, SecondOrder, ZERO};

const GAMMA: f64 = 0.25;
const STAGES: usize = 6;

/// a_ij of stages 2 to 5; stage 6 starts from stage 5 with U₅ added.
const A: [[f64; 4]; 4] = [
    [1.544, 0.0, 0.0, 0.0],
    [0.946_678_528_081_582_6, 0.255_701_169_898_328_4, 0.0, 0.0],
    [3.314_825_187_068_521, 2.896_124_015_972_201, 0.998_641_913_997_781_7, 0.0],
    [1.221_224_509_226_641, 6.019_134_481_288_629, 12.537_083_329_320_87, -0.687_886_036_105_895],
];

/// c_ij of stages 2 to 6.
const C: [[f64; 5]; 5] = [
    [-5.6688, 0.0, 0.0, 0.0, 0.0],
    [-2.430_093_356_833_875, -0.206_359_915_709_191_5, 0.0, 0.0, 0.0],
    [-0.107_352_905_815_137_5, -9.594_562_251_023_355, -20.470_286_148_096_16, 0.0, 0.0],
    [7.496_443_313_967_647, -10.246_804_314_643_52, -33.999_903_528_199_05, 11.708_908_932_061_6, 0.0],
    [
        8.083_246_795_921_522,
        -7.981_132_988_064_893,
        -31.521_594_328_743_71,
        16.319_305_431_231_36,
        -6.058_818_238_834_054,
    ],
];

/// Continuous extension of order 3, evaluated at the middle of the step.
const MIDDLE: [[f64; 5]; 2] = [
    [
        10.126_235_083_445_86,
        -7.487_995_877_610_167,
        -34.800_918_615_557_47,
        -7.992_771_707_568_823,
        1.025_137_723_295_662,
    ],
    [
        -0.676_280_339_280_125_3,
        6.087_714_651_680_015,
        16.430_843_208_924_78,
        24.767_225_114_183_86,
        -6.594_389_125_716_872,
    ],
];

/// Result of a step that may still be rejected.
#[derive(Clone, Copy, Debug, Default)]
pub struct Trial {
    /// Solution of order 4.
    pub end: Point,
    /// Continuous extension of order 3 at the middle of the step.
    pub middle: Point,
    /// Difference to the embedded solution of order 3.
    pub error: Point,
}

/// Right-hand sides per step besides the linearisation.
pub const EVALUATIONS: u64 = 5;

/// One step of size `h` from `start`, where `lin` was taken. `None` if the matrix is singular.
#[inline]
pub fn step<S: SecondOrder>(system: &S, start: &Point, lin: &Linearisation, h: f64) -> Option<Trial> {
    let n = system.dof();
    let s = h * GAMMA;
    let mut matrix = lin.by_position;
    system.times_rates(&mut matrix);
    for i in 0..n {
        for j in 0..n {
            matrix[i][j] = -lin.by_velocity[i][j] - s * matrix[i][j];
        }
        matrix[i][i] += 1.0 / s;
    }
    let lu = Lu::new(matrix, n)?;

    let mut u = [Point::default(); STAGES];
    let mut y = *start;
    let mut acceleration = lin.acceleration;
    for stage in 0..STAGES {
        if stage > 0 {
            if stage < STAGES - 1 {
                y = *start;
                for (j, a) in A[stage - 1].iter().enumerate().take(stage) {
                    accumulate(&mut y, *a, &u[j], n);
                }
            } else {
                accumulate(&mut y, 1.0, &u[stage - 1], n);
            }
            system.evaluate(&y, &mut acceleration);
        }
        let mut r = Point { q: system.rates(&y.v), v: acceleration };
        if stage > 0 {
            for (j, c) in C[stage - 1].iter().enumerate().take(stage) {
                accumulate(&mut r, c / h, &u[j], n);
            }
        }
        for i in 0..n {
            for j in 0..n {
                r.v[i] += s * lin.by_position[i][j] * r.q[j];
            }
        }
        lu.solve(&mut r.v);
        let rate = system.rates(&r.v);
        for i in 0..n {
            r.q[i] = s * (r.q[i] + rate[i]);
        }
        u[stage] = r;
    }
    let mut end = y;
    accumulate(&mut end, 1.0, &u[STAGES - 1], n);

    // y(½) = ½ y₀ + ½ (y₁ + ½ (Σ D₂ U + ½ Σ D₃ U))
    let mut middle = Point { q: ZERO, v: ZERO };
    accumulate(&mut middle, 0.5, start, n);
    accumulate(&mut middle, 0.5, &end, n);
    for j in 0..5 {
        accumulate(&mut middle, 0.25 * MIDDLE[0][j] + 0.125 * MIDDLE[1][j], &u[j], n);
    }
    Some(Trial { end, middle, error: u[STAGES - 1] })
}

#[inline]
fn accumulate(y: &mut Point, factor: f64, u: &Point, n: usize) {
    for i in 0..n {
        y.q[i] += factor * u.q[i];
        y.v[i] += factor * u.v[i];
    }
}

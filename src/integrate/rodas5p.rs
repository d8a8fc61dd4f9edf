//! Rodas5P: a Rosenbrock method of order 5 with embedded order 4, eight stages, L-stable and stiffly accurate.
//!
//! Source: G. Steinebach, Construction of Rosenbrock–Wanner method Rodas5P and numerical benchmarks within the Julia
//! Differential Equations package, BIT Numerical Mathematics 63:27 (2023). On stiff problems with smooth forcing
//! (Prothero–Robinson), such as a damped mesh rolling through its tooth cycle, the error stays O(h⁴).
//!
//! In the transformed variables U (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer
//! 1996, section IV.7) a step of size h from y₀ is
//!
//!   (I/hγ − J) U_i = f(y₀ + Σ a_ij U_j) + Σ c_ij U_j / h,   y₁ = y₀ + Σ a_sj U_j + U_s,   error = U_s
//!
//! where the last stage starts from the embedded solution. A driven system becomes autonomous with the additional
//! equation ṫ = 1, whose U_i are h g_i with constants g_i = γ (1 + Σ c_ij g_j). The stages are at t₀ + h Σ a_ij g_j,
//! and h g_i ∂f/∂t is added to the right-hand side.

use super::block::Block;
use super::linear::Shape;
use super::method::combine;
use super::{ErrorNorm, Linearisation, Method, Point, SecondOrder, StepOutput, TimedPoint, Trial};

/// The method.
pub struct Rodas5P;

impl Method for Rodas5P {
    #[inline(always)]
    fn estimate_order(&self) -> u32 {
        4
    }

    #[inline(always)]
    fn step<const N: usize, S: SecondOrder<N> + ?Sized>(
        &self,
        system: &S,
        TimedPoint { point: start, time }: TimedPoint<N>,
        lin: &Linearisation<N, S::Rates>,
        h: f64,
        norm: &ErrorNorm<N>,
        StepOutput { counts, extension }: StepOutput<N>,
    ) -> Option<Trial<N, S::Rates>> {
        let shape = Shape::of(system);
        let mut block = Block::EMPTY;
        block.fill(system, shape, lin, h * GAMMA)?;
        let per_h = 1.0 / h;
        let drift = system.is_driven().then(|| system.drift(start, time));
        let mut u = [Point::ZERO; STAGES];
        let mut y = *start;
        let mut acceleration = lin.acceleration;
        for stage in 0..STAGES {
            if let Some(row) = stage.checked_sub(1) {
                if let Some(weights) = A.get(row) {
                    y = *start;
                    combine(&mut y, weights, 1.0, &u);
                } else {
                    combine(&mut y, &[1.0], 1.0, &u[row..]);
                }
                acceleration = system.accelerate_at(&y, time + h * NODES[stage]);
            }
            let mut r = Point { q: system.rates(&y.v), v: acceleration };
            if let Some(row) = stage.checked_sub(1) {
                combine(&mut r, C[row], per_h, &u);
            }
            if let Some(drift) = &drift {
                for i in 0..N {
                    r.v[i] += h * G[stage] * drift[i];
                }
            }
            block.solve(system, shape, &mut r);
            u[stage] = r;
        }
        let error = u[STAGES - 1];
        let mut end = y;
        combine(&mut end, &[1.0], 1.0, &[error]);
        let size = norm.judge(&error, &end);
        (extension.start, extension.end) = (*start, end);
        if size <= 1.0 {
            for (coefficient, weights) in extension.coefficients.iter_mut().zip(&EXTENSION) {
                *coefficient = Point::ZERO;
                combine(coefficient, weights, 1.0, &u);
            }
        }
        let trial = Trial { error, size, halfway: None };
        counts.evaluations += C.len() as u64;
        let solve = |defect: &mut Point<N>| block.solve(system, shape, defect);
        Some(trial.with_midpoint_check(system, (extension, time, h), norm, counts, solve))
    }
}

/// Number of stages.
const STAGES: usize = 8;

/// Diagonal coefficient γ.
const GAMMA: f64 = 0.211_937_563_194_290_14;

/// a_ij from the second stage onwards. Stages without a row start from the previous stage plus its U. They are embedded
/// solutions; the last one gives the error estimate.
const A: [&[f64]; 5] = [
    &[3.0],
    &[2.849_394_379_747_939, 0.458_422_422_044_639_23],
    &[-6.954_028_509_809_101, 2.489_845_061_869_568, -10.358_996_098_473_584],
    &[2.802_998_627_562_896_4, 0.507_246_473_622_820_6, -0.398_831_254_177_052_4, -0.047_211_872_304_046_41],
    &[
        -7.502_846_399_306_121,
        2.561_846_144_803_919,
        -11.627_539_656_261_098,
        -0.182_687_676_599_422_56,
        0.030_198_172_008_377_946,
    ],
];

/// c_ij from the second stage onwards.
const C: [&[f64]; STAGES - 1] = [
    &[-14.155_112_264_123_755],
    &[-17.972_960_358_859_52, -2.859_693_295_451_294],
    &[147.121_502_757_117_16, -1.412_214_027_182_13, 71.689_402_513_023_58],
    &[165.435_170_248_716_76, -0.459_282_345_649_112_6, 42.909_383_369_586_03, -5.961_986_721_573_306],
    &[
        24.854_864_614_690_072,
        -3.000_922_700_283_218_6,
        47.493_111_002_076_8,
        5.581_419_782_155_812_5,
        -0.661_069_182_524_947_1,
    ],
    &[
        30.912_732_140_285_99,
        -3.120_824_334_993_797_4,
        77.799_546_460_708_92,
        34.286_460_282_947_83,
        -19.097_331_116_725_623,
        -28.087_943_162_872_662,
    ],
    &[
        37.802_771_233_905_63,
        -3.257_196_902_907_227_6,
        112.269_188_494_963_27,
        66.934_723_124_404_7,
        -40.066_189_370_910_02,
        -54.667_802_628_779_68,
        -9.488_616_523_096_27,
    ],
];

/// g_i of the stages.
const G: [f64; STAGES] = {
    let mut g = [0.0; STAGES];
    let mut stage = 0;
    while stage < STAGES {
        let sum = if stage == 0 { 0.0 } else { weighted(C[stage - 1], &g) };
        g[stage] = GAMMA * (1.0 + sum);
        stage += 1;
    }
    g
};

/// Nodes of the stages, as fractions of the step. Embedded solutions are at its end.
const NODES: [f64; STAGES] = {
    let mut nodes = [1.0; STAGES];
    nodes[0] = 0.0;
    let mut row = 0;
    while row < A.len() {
        nodes[row + 1] = weighted(A[row], &G);
        row += 1;
    }
    nodes
};

const fn weighted(weights: &[f64], g: &[f64; STAGES]) -> f64 {
    let (mut sum, mut j) = (0.0, 0);
    while j < weights.len() {
        sum += weights[j] * g[j];
        j += 1;
    }
    sum
}

/// Weights of the continuous extension y(Θ) = (1−Θ) y₀ + Θ (y₁ + (1−Θ) (H₂U + Θ (H₃U + Θ H₄U))).
const EXTENSION: [[f64; STAGES]; 3] = [
    [
        25.948_786_856_663_858,
        -2.557_972_484_584_623_5,
        10.433_815_404_888_879,
        -2.367_925_102_268_520_4,
        0.524_948_541_321_073,
        1.124_108_831_045_040_4,
        0.427_287_619_443_187_4,
        -0.172_022_210_701_554_93,
    ],
    [
        -9.915_688_506_951_71,
        -0.968_994_459_411_515_4,
        3.043_803_724_297_845_3,
        -24.495_224_566_215_796,
        20.176_138_334_709_044,
        15.980_663_614_246_51,
        -6.789_040_303_419_874,
        -6.710_236_069_923_372,
    ],
    [
        11.419_903_575_922_262,
        2.887_964_514_613_699_4,
        72.921_379_959_960_29,
        80.125_118_346_226_43,
        -52.072_871_366_152_654,
        -59.789_936_252_667_29,
        -0.155_826_842_827_519_13,
        4.883_087_185_713_722,
    ],
];

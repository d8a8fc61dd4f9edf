//! Rosenbrock methods on the second-order block, from a tableau.
//!
//! In the transformed variables U (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer
//! 1996, section IV.7) a step of size h from y₀ is
//!
//!   (I/hγ − J) U_i = f(y₀ + Σ a_ij U_j) + Σ c_ij U_j / h,   y₁ = y₀ + Σ a_sj U_j + U_s,   error = U_s
//!
//! for stiffly accurate methods, whose last stage starts from the embedded solution. A driven system is the autonomous one
//! with ṫ = 1 as one more equation, whose U_i are h g_i with g_i = γ (1 + Σ c_ij g_j) whatever the system: stages lie at
//! t₀ + h Σ a_ij g_j, and h g_i ∂f/∂t joins the right-hand side.

use super::block::Block;
use super::linear::Shape;
use super::method::combine;
use super::{ErrorNorm, Extension, Linearisation, Point, SecondOrder, Statistics, Trial};

/// Coefficients of a stiffly accurate Rosenbrock method with `S` stages.
pub struct Tableau<const S: usize> {
    /// Diagonal coefficient γ.
    pub gamma: f64,
    /// a_ij from the second stage on. Stages without a row start from the one before plus its U: they are embedded
    /// solutions, the last one that of the error estimate.
    pub a: &'static [&'static [f64]],
    /// c_ij from the second stage on.
    pub c: &'static [&'static [f64]],
    /// Weights of the stages in the coefficients of the continuous extension; those that are left out are zero.
    pub extension: &'static [[f64; S]],
}

impl<const S: usize> Tableau<S> {
    /// Where stage `i` lies in the step, from the g of the stages before.
    fn place(&self, i: usize, g: &[f64; S]) -> f64 {
        let weighted = |weights: &[f64]| weights.iter().zip(g).map(|(a, g)| a * g).sum::<f64>();
        match self.a.get(i - 1) {
            Some(weights) => weighted(weights),
            // embedded solutions lie at the end
            None => 1.0,
        }
    }

    /// Σ c_ij g_j of stage `i`.
    fn carried(&self, i: usize, g: &[f64; S]) -> f64 {
        let row = i.checked_sub(1).map_or(&[][..], |row| self.c[row]);
        row.iter().zip(g).map(|(c, g)| c * g).sum()
    }
}

/// One step of size `h` from `start` at `time`, where `lin` was taken. `None` if the matrix is singular. Counts its evaluations.
#[inline(always)]
pub fn step<const S: usize, const N: usize, E: SecondOrder<N> + ?Sized>(
    tableau: &Tableau<S>,
    system: &E,
    (start, time): (&Point<N>, f64),
    (lin, h): (&Linearisation<N, E::Rates>, f64),
    norm: &ErrorNorm<N>,
    (counts, extension): (&mut Statistics, &mut Extension<N>),
) -> Option<Trial<N, E::Rates>> {
    let shape = Shape::of(system);
    let mut block = Block::EMPTY;
    block.fill((system, shape), lin, h * tableau.gamma)?;
    let per_h = 1.0 / h;
    let drift = system.is_driven().then(|| system.drift(start, time));
    let mut g = [0.0; S];
    let mut u = [Point::ZERO; S];
    let mut y = *start;
    let mut acceleration = lin.acceleration;
    for stage in 0..S {
        if let Some(row) = stage.checked_sub(1) {
            if let Some(weights) = tableau.a.get(row) {
                y = *start;
                combine(&mut y, weights, 1.0, &u);
            } else {
                combine(&mut y, &[1.0], 1.0, &u[row..]);
            }
            let later = if drift.is_some() { h * tableau.place(stage, &g) } else { 0.0 };
            acceleration = system.accelerate_at(&y, time + later);
        }
        let mut r = Point { q: system.rates(&y.v), v: acceleration };
        if let Some(row) = stage.checked_sub(1) {
            combine(&mut r, tableau.c[row], per_h, &u);
        }
        if let Some(drift) = &drift {
            g[stage] = tableau.gamma * (1.0 + tableau.carried(stage, &g));
            for i in 0..N {
                r.v[i] += h * g[stage] * drift[i];
            }
        }
        block.solve((system, shape), &mut r);
        u[stage] = r;
    }
    let error = u[S - 1];
    let mut end = y;
    combine(&mut end, &[1.0], 1.0, &[error]);
    let size = norm.judge(&error, &end);
    (extension.start, extension.end) = (*start, end);
    if size <= 1.0 {
        for (k, coefficient) in extension.coefficients.iter_mut().enumerate() {
            *coefficient = Point::ZERO;
            if let Some(weights) = tableau.extension.get(k) {
                combine(coefficient, weights, 1.0, &u);
            }
        }
    }
    let trial = Trial { error, size, halfway: None };
    counts.evaluations += tableau.c.len() as u64;
    let solve = |defect: &mut Point<N>| block.solve((system, shape), defect);
    Some(trial.looked_into(system, (extension, time, h), norm, counts, solve))
}

//! Tests that compare errors with their estimates and with the tolerance, and check the counts of evaluations.

use std::cell::Cell;

use bevel_differential::integrate::{Linearisation, Matrix, Point, SecondOrder};

use super::methods::{Known, run, step, with_every_method};
use super::problems::{Logarithmic, distance, forced, forced_exact};

with_every_method!(
    errors_are_within_their_estimates
    error_follows_the_tolerance
    every_evaluation_is_counted
);

/// Ratio of local errors to their estimates. Both are summed over steps of size `h` from many points along an exact
/// solution, because an estimate may pass through zero somewhere without being wrong.
fn error_over_estimate<M: Known, S: SecondOrder<2>>(s: &S, exact: impl Fn(f64) -> Point<2>, h: f64) -> f64 {
    let (mut errors, mut estimates) = (0.0, 0.0);
    for k in 0..60 {
        let time = 0.1 * f64::from(k);
        let trial = step::<M, 2, S>(s, &exact(time), h);
        errors += distance(&trial.extension.end, &exact(time + h));
        estimates += distance(&trial.error, &Point::ZERO);
    }
    errors / estimates
}

fn errors_are_within_their_estimates<M: Known>() {
    for h in [0.1, 0.05, 0.025, 0.0125] {
        let ratio = error_over_estimate::<M, _>(&Logarithmic, Logarithmic::exact, h);
        println!("h = {h}: {ratio:.1e}");
        assert!(ratio < 1.0, "h = {h}: errors are {ratio} of their estimates");
        // also for stiff problems
        for lambda in [1.0, 10.0, 1e2, 1e3, 1e5] {
            let ratio = error_over_estimate::<M, _>(&forced(lambda), forced_exact, h);
            println!("h = {h}, λ = {lambda:e}: {ratio:.1e}");
            assert!(ratio < 1.0, "h = {h}, λ = {lambda:e}: errors are {ratio} of their estimates");
        }
    }
}

fn error_follows_the_tolerance<M: Known>() {
    let mut last = f64::INFINITY;
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut point = Logarithmic::exact(0.0);
        let statistics = run::<M, 2, _>(&Logarithmic, &mut point, 3.0, tolerance).unwrap();
        let error = distance(&point, &Logarithmic::exact(3.0));
        println!("{tolerance:e}: error {error:.1e}, {statistics:?}");
        assert!(error < 20.0 * tolerance && error < last, "tolerance {tolerance:e}: error {error:e}");
        last = error;
    }
}

/// Counts the calls of a system.
struct Counting<S> {
    inner: S,
    evaluations: Cell<u64>,
    jacobians: Cell<u64>,
}

impl<const N: usize, S: SecondOrder<N>> SecondOrder<N> for Counting<S> {
    type Rates = S::Rates;

    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        self.inner.rates(v)
    }
    fn times_rates(&self, m: &mut Matrix<N>) {
        self.inner.times_rates(m);
    }
    fn evaluate(&self, at: &Point<N>) -> ([f64; N], S::Rates) {
        self.evaluations.set(self.evaluations.get() + 1);
        self.inner.evaluate(at)
    }
    fn linearise(&self, at: &Point<N>) -> Linearisation<N, S::Rates> {
        self.evaluations.set(self.evaluations.get() + 1);
        self.jacobians.set(self.jacobians.get() + 1);
        self.inner.linearise(at)
    }
    fn weights(&self, at: &Point<N>) -> Point<N> {
        self.inner.weights(at)
    }
}

fn every_evaluation_is_counted<M: Known>() {
    let s = Counting { inner: Logarithmic, evaluations: Cell::new(0), jacobians: Cell::new(0) };
    let statistics = run::<M, 2, _>(&s, &mut Logarithmic::exact(0.0), 3.0, 1e-6).unwrap();
    assert!(statistics.accepted > 10);
    assert_eq!((statistics.evaluations, statistics.jacobians), (s.evaluations.get(), s.jacobians.get()));
}

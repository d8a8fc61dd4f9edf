//! Draws that fastrand does not have.

use fastrand::Rng;

/// Draws of the random checks, on top of a generator that gives the same numbers for the same seed on every machine.
pub trait Draws {
    /// Number from 0 to `n` - 1; 0 if `n` is 0.
    fn below(&mut self, n: usize) -> usize;
    /// True once in `n`.
    fn chance(&mut self, n: usize) -> bool;
    /// One of `from`, which is not empty.
    fn pick<T: Clone>(&mut self, from: &[T]) -> T;
    /// Number from `low` to `high`, evenly.
    fn between(&mut self, low: f64, high: f64) -> f64;
}

impl Draws for Rng {
    fn below(&mut self, n: usize) -> usize {
        if n == 0 { 0 } else { self.usize(..n) }
    }

    fn chance(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    fn pick<T: Clone>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())].clone()
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.f64() * (high - low)
    }
}

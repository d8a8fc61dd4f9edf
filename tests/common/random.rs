//! Random draws for tests and the laboratory that fastrand does not provide. Its generator gives the same numbers for
//! the same seed on every machine.
#![allow(dead_code)] // each program uses only some items

use fastrand::Rng;

/// Random draws from a generator.
pub trait Draws {
    /// Number from 0 to `n` - 1; 0 if `n` is 0.
    fn below(&mut self, n: usize) -> usize;
    /// Integer from `low` to `high`, both included.
    fn whole(&mut self, low: i32, high: i32) -> i32;
    /// Number from `low` to `high`, uniformly distributed.
    fn between(&mut self, low: f64, high: f64) -> f64;
    /// Number from `middle / factor` to `middle * factor`, uniformly distributed in its logarithm.
    fn about(&mut self, middle: f64, factor: f64) -> f64;
    /// True with probability 1 / `n`.
    fn chance(&mut self, n: usize) -> bool;
    /// True with probability `share`.
    fn share(&mut self, share: f64) -> bool;
    /// One element of `from`, which is not empty.
    fn pick<T: Clone>(&mut self, from: &[T]) -> T;
}

impl Draws for Rng {
    fn below(&mut self, n: usize) -> usize {
        if n == 0 { 0 } else { self.usize(..n) }
    }

    fn whole(&mut self, low: i32, high: i32) -> i32 {
        self.i32(low..=high)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.f64() * (high - low)
    }

    fn about(&mut self, middle: f64, factor: f64) -> f64 {
        middle * factor.powf(self.between(-1.0, 1.0))
    }

    fn chance(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    fn share(&mut self, share: f64) -> bool {
        self.f64() < share
    }

    fn pick<T: Clone>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())].clone()
    }
}

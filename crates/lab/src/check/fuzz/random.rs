//! Random values such as careless hosts pass.

use bevel_differential::variables::{Access, Variable, real_start};

pub use crate::tools::random::Random;

impl Random {
    /// Any number, often a hard one: zero, NaN, infinite, tiny or huge.
    pub fn real(&mut self) -> f64 {
        let any = f64::from_bits(self.bits());
        let near = (self.below(2001) as f64 - 1000.0) * 10f64.powi(self.below(9) as i32 - 6);
        let hard = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, 5e-324, f64::MAX, -1e300];
        let hard = self.pick(&hard);
        self.pick(&[near, near, near, any, hard])
    }

    /// A value for a real variable: mostly near its start value, now and then from its range, or any.
    pub fn value_for(&mut self, row: &Variable) -> f64 {
        let start = real_start(row).unwrap_or(0.0);
        match (self.below(8), row.range) {
            (0, _) | (1..=2, None) => self.real(),
            (1, Some(range)) => range.min + self.fraction() * (range.max - range.min),
            (2, Some(range)) => self.pick(&[range.min, range.max]),
            _ => start * (0.8 + 0.4 * self.fraction()),
        }
    }

    /// A value for an integer, a choice or a switch: mostly one that exists.
    pub fn integer_for(&mut self, row: &Variable) -> i32 {
        if self.chance(8) {
            return self.bits() as i32;
        }
        match (row.access, row.range) {
            (Access::Enumeration(kind, ..), _) => self.below(kind.choices.len() + 1) as i32 + 1,
            (Access::Boolean(_), _) => self.below(2) as i32,
            (_, Some(range)) => (range.min + self.fraction() * (range.max.min(24.0) - range.min)).round() as i32,
            _ => self.below(20) as i32,
        }
    }

    /// A copy of one of `from`, which is not empty.
    pub fn pick_clone<T: Clone>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())].clone()
    }
}

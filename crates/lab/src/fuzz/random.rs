//! Random values that careless hosts might pass.

use bevel_differential::variables::{Access, Variable, real_start};
use fastrand::Rng;

use crate::random::Draws;

/// Draws any number, often a difficult one: zero, NaN, infinite, tiny or huge.
pub fn real(r: &mut Rng) -> f64 {
    let any = f64::from_bits(r.u64(..));
    let near = (r.below(2001) as f64 - 1000.0) * 10f64.powi(r.below(9) as i32 - 6);
    let hard = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, 5e-324, f64::MAX, -1e300];
    let hard = r.pick(&hard);
    r.pick(&[near, near, near, any, hard])
}

/// Draws a value for a real variable: mostly near its start value, sometimes from its range, sometimes any.
pub fn value_for(r: &mut Rng, row: &Variable) -> f64 {
    let start = real_start(row).unwrap_or(0.0);
    match (r.below(8), row.range) {
        (0, _) | (1..=2, None) => real(r),
        (1, Some(range)) => r.between(range.min, range.max),
        (2, Some(range)) => r.pick(&[range.min, range.max]),
        _ => start * r.between(0.8, 1.2),
    }
}

/// Draws a value for an integer, an enumeration or a Boolean, mostly a valid one.
pub fn integer_for(r: &mut Rng, row: &Variable) -> i32 {
    if r.chance(8) {
        return r.i32(..);
    }
    match (row.access, row.range) {
        (Access::Enumeration(kind, ..), _) => r.below(kind.choices.len() + 1) as i32 + 1,
        (Access::Boolean(_), _) => r.below(2) as i32,
        (_, Some(range)) => r.between(range.min, range.max.min(24.0)).round() as i32,
        _ => r.below(20) as i32,
    }
}

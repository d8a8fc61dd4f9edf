//! Smooth bounds: a quantity is unchanged on one side of a band, equals the bound on the other, and is C² between.
//!
//! With t = (x − a)/h, the band |t| < 1 is bridged by a + h (1 + t)³(3 − t)/16. Its slope changes from 0 to 1, and its
//! curvature vanishes at both ends. Outside the band the value is exact, unlike with exponentials and roots. A
//! published formula is therefore unchanged in its range of validity.

use crate::numeric::Scalar;

/// Limits `x` from below: `x` itself from `bound` + `half_width` on, `bound` up to `bound` − `half_width`.
#[inline]
pub fn floor<T: Scalar>(x: T, bound: f64, half_width: f64) -> T {
    let t = (x.value() - bound) / half_width;
    if t >= 1.0 {
        x
    } else if t > -1.0 {
        let square = (1.0 + t) * (1.0 + t);
        let value = bound + half_width * square * (1.0 + t) * (3.0 - t) / 16.0;
        x.through([value, square * (2.0 - t) / 4.0, 0.75 * (1.0 + t) * (1.0 - t) / half_width])
    } else {
        T::constant(bound)
    }
}

/// Limits `x` from above: `x` itself up to `bound` − `half_width`, `bound` from `bound` + `half_width` on.
#[inline]
pub fn ceiling<T: Scalar>(x: T, bound: f64, half_width: f64) -> T {
    -floor(-x, -bound, half_width)
}

/// Limits `x` to two positive bounds. The value is unchanged from 1.5 times the lower to half of the upper bound.
#[inline]
pub fn hold<T: Scalar>(x: T, [low, high]: [f64; 2]) -> T {
    ceiling(floor(x, low, 0.5 * low), high, 0.5 * high)
}

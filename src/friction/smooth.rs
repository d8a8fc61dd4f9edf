//! Smooth bounds: a quantity is unchanged on one side of a band, equals the bound on the other, and is C² between.
//!
//! With t = (x − a)/h, the band |t| < 1 is bridged by a + h (1 + t)³(3 − t)/16, whose slope runs from 0 to 1 and whose
//! curvature vanishes at both ends. Beyond the band the value is exact, unlike with exponentials and roots, so that a
//! published formula stays untouched where it holds.

use crate::numeric::Scalar;

/// Not below `bound`: `x` itself from `bound` + `half_width`, the bound up to `bound` − `half_width`.
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

/// Not above `bound`: `x` itself up to `bound` − `half_width`, the bound from `bound` + `half_width`.
#[inline]
pub fn ceiling<T: Scalar>(x: T, bound: f64, half_width: f64) -> T {
    -floor(-x, -bound, half_width)
}

/// Between two positive bounds; `x` itself from 1.5 times the lower to half of the upper.
#[inline]
pub fn hold<T: Scalar>(x: T, [low, high]: [f64; 2]) -> T {
    ceiling(floor(x, low, 0.5 * low), high, 0.5 * high)
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Dual;

    #[test]
    fn a_bound_meets_both_sides_with_slope_and_curvature() {
        let at = |x: f64| floor(Dual::<1>::variable(x, 0), 2.0, 0.5);
        let h = 1e-6;
        for x in [0.0, 1.5 - h, 1.5 + h, 1.7, 2.0, 2.3, 2.5 - h, 2.5 + h, 9.0] {
            let slope = (at(x + h).v - at(x - h).v) / (2.0 * h);
            assert!((slope - at(x).d[0]).abs() < 1e-8, "{x}");
            let curvature = (at(x + h).d[0] - at(x - h).d[0]) / (2.0 * h);
            assert!(curvature > -1e-9 && curvature < 2.0 && at(x).v >= 2.0);
        }
        for x in [1.5, 2.5] {
            assert!(((at(x + h).d[0] - at(x - h).d[0]) / (2.0 * h)).abs() < 1e-4, "curvature jumps at {x}");
        }
        assert_eq!((at(2.5).v, at(3.0).v, at(1.5).v, at(-1e300).v), (2.5, 3.0, 2.0, 2.0));
        assert_eq!((ceiling(0.19, 0.3, 0.1), ceiling(5.0, 0.3, 0.1)), (0.19, 0.3));
        assert_eq!((hold(0.0, [1.0, 10.0]), hold(4.0, [1.0, 10.0]), hold(99.0, [1.0, 10.0])), (1.0, 4.0, 10.0));
    }
}

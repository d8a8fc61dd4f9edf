//! Elementary functions with the same bits on every system, from the `libm` crate.

pub use libm::{acos, asin, atan2, cos, pow, sin, tan};
pub use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Square root of `x`, correctly rounded by the processor. `libm` would use an SSE instruction, which waits for
/// preceding AVX instructions.
#[inline(always)]
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// Sine and cosine of `x`, cheaper than two separate calls.
///
/// For |x| up to 1/2 it uses Taylor series whose remainder is below rounding. Arcs along a flank are rarely longer.
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    if x.abs() > 0.5 {
        return libm::sincos(x);
    }
    let z = x * x;
    let sin = SINE.iter().rev().fold(0.0, |sum, term| term + z * sum);
    let cos = COSINE.iter().rev().fold(0.0, |sum, term| term + z * sum);
    (x + x * z * sin, 1.0 - (0.5 * z - z * z * cos))
}

/// Terms of the sine's series from x³ on, and of the cosine's from x⁴ on: ±1/n!.
const SINE: [f64; 6] =
    [-1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0, -1.0 / 39_916_800.0, 1.0 / 6_227_020_800.0];
const COSINE: [f64; 6] =
    [1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0, -1.0 / 3_628_800.0, 1.0 / 479_001_600.0, -1.0 / 87_178_291_200.0];

/// Magnitude from which a quotient counts as infinite.
const INFINITE: f64 = 1e100;

/// Quotient of `a` and `b`, or `None` if `b` is 0 or the quotient is so large that it has no use. No division overflows.
#[inline]
pub fn quotient(a: f64, b: f64) -> Option<f64> {
    let quotient = a / b.abs().max(a.abs() / INFINITE).max(f64::MIN_POSITIVE).copysign(b);
    // compilers divide before they test, so the divisor must be valid in any case
    (a.abs() < INFINITE * b.abs()).then_some(quotient)
}

/// Fractional part of `x` in [0, 1).
pub fn frac(x: f64) -> f64 {
    let f = x - libm::floor(x);
    if f < 1.0 { f } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quotient_exists_if_it_is_not_infinite() {
        for (a, b) in [(6.0, -4.0), (-1e-3, 3.0), (0.0, -2.0), (7.0, f64::MIN_POSITIVE * 1e220), (1e90, 1e-9)] {
            assert_eq!(quotient(a, b), Some(a / b));
        }
        for (a, b) in [(1.0, 0.0), (0.0, 0.0), (-1.0, 1e-101), (f64::NAN, 1.0), (1.0, f64::NAN)] {
            assert_eq!(quotient(a, b), None);
        }
    }
}

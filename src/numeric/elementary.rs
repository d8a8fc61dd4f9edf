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

/// Fractional part of `x` in [0, 1).
pub fn frac(x: f64) -> f64 {
    let f = x - libm::floor(x);
    if f < 1.0 { f } else { 0.0 }
}

//! Elementary functions with the same bits on every system, from the `libm` crate.

pub use libm::{acos, asin, atan2, cos, pow, sin, sqrt, tan};
pub use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Sine and cosine of `x`, for less than both apart.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// Fractional part of `x` in [0, 1).
pub fn frac(x: f64) -> f64 {
    let f = x - libm::floor(x);
    if f < 1.0 { f } else { 0.0 }
}

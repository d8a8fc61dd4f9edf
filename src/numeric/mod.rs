//! Elementary functions with the same bits on every system, from the `libm` crate, and numbers that carry derivatives.

pub use libm::{acos, asin, atan2, cos, pow, sin, sqrt, tan};
pub use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Fractional part of `x` in [0, 1).
pub fn frac(x: f64) -> f64 {
    let f = x - libm::floor(x);
    if f < 1.0 { f } else { 0.0 }
}

mod jet;
mod scalar;
mod smooth;
pub use jet::Jet;
pub use scalar::{Dual, Scalar};
pub use smooth::{Curved, Partials, Smooth};

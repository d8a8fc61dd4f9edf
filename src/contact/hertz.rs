//! Contact stiffness of two spheres by Hertz, as in the study.
//!
//! K = 4/3 √R E*, with 1/R = 1/r_p + 1/r_s from the outer pitch radii, and E* = E / (2(1−ν²)) for equal materials.

use crate::numeric::sqrt;

/// Exponent of the force law with this stiffness.
pub const EXPONENT: f64 = 1.5;

/// Stiffness K [N/m^1.5] of spheres with the pair's outer pitch radii `r_p`, `r_s` [m], modulus [Pa] and Poisson's
/// ratio.
pub fn stiffness(r_p: f64, r_s: f64, young_modulus: f64, poisson_ratio: f64) -> f64 {
    let radius = r_p * r_s / (r_p + r_s);
    let modulus = young_modulus / (2.0 * (1.0 - poisson_ratio * poisson_ratio));
    4.0 / 3.0 * sqrt(radius) * modulus
}

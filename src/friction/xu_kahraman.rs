//! Xu and Kahraman: μ = e^f · P^b₂ |SR|^b₃ V_e^b₆ ν₀^b₇ R^b₈,
//! f = b₁ + b₄ |SR| P log₁₀ν₀ + b₅ exp(−|SR| P log₁₀ν₀) + b₉ exp(S).
//!
//! SR = v_s/V_e is the slide-to-roll ratio with the entraining speed V_e = v_Σ/2 [m/s], P the largest Hertzian pressure
//! [GPa], ν₀ the dynamic viscosity at the inlet [cP], and R the relative radius of curvature [m]. S is the rms
//! roughness [µm], taken as √(π/2) R_a as on a Gaussian surface. The fit vanishes with the sliding speed, like a film
//! without limiting shear stress.
//!
//! Source: Xu (2005), Development of a generalized mechanical efficiency prediction methodology for gear pairs, thesis,
//! Ohio State University; Xu, Kahraman, Anderson, Maddock (2007), J. Mech. Des. 129, p. 58. Coefficients and units were
//! compared with two later uses of the formula. It was fitted to one oil, 75W-90.

use super::{Conditions, Outside, ToothFrictionSpec, smooth};
use crate::numeric::Scalar;

/// b₁ … b₉, at indices 1 to 9.
const B: [f64; 10] = [0.0, -8.916465, 1.03303, 1.036077, -0.354068, 2.812084, -0.100601, 0.752755, -0.390958, 0.620305];

/// Upper bound of the slide-to-roll ratio, and half the width of its transition. A surface at rest has the ratio 2; the
/// largest fitted ratio is 1.
const MAX_SLIDING: [f64; 2] = [3.0, 1.0];

/// Upper bound of the roughness [µm]; e^S is meaningless far beyond the fit.
const ROUGHEST: f64 = 1.5;

/// Ratio of rms to arithmetic mean roughness of a Gaussian surface, √(π/2).
const RMS: f64 = 1.253_314_137_315_5;

const SOURCE: &str = "range of the EHL solutions, Xu 2005";

/// S [µm].
fn rms(spec: &ToothFrictionSpec) -> f64 {
    RMS * spec.micrometres()
}

/// Coefficient at positive speeds, load and radius.
pub fn coefficient<T: Scalar>(spec: &ToothFrictionSpec, at: &Conditions<T>) -> T {
    let entraining = at.sum_speed * 0.5;
    let ratio = smooth::ceiling(at.sliding / entraining, MAX_SLIDING[0], MAX_SLIDING[1]);
    let pressure = at.pressure() * 1e-9; // GPa
    // below 1 cP the logarithm changes its sign and the exponential grows without bound
    let viscosity = spec.centipoise().max(1.0);
    let product = ratio * pressure * libm::log10(viscosity);
    let constant = B[1] + B[9] * libm::exp(rms(spec).min(ROUGHEST));
    let f = product * B[4] + (-product).exp() * B[5] + constant;
    // all powers in one exponential
    let powers = pressure.ln() * B[2]
        + ratio.ln() * B[3]
        + entraining.ln() * B[6]
        + at.radius.ln() * B[8]
        + libm::log(viscosity) * B[7];
    (f + powers).exp()
}

/// Returns the quantity outside the range of the fit, or `None`. The limits were not compared with the thesis's own
/// table of cases.
pub fn outside(spec: &ToothFrictionSpec, at: &Conditions<f64>) -> Option<Outside> {
    let entraining = 0.5 * at.sum_speed;
    [
        (("entraining speed V_e", "m/s"), entraining, [1.0, 20.0]),
        (("slide-to-roll ratio SR", "1"), at.sliding / entraining, [0.0, 1.0]),
        (("Hertzian pressure P", "GPa"), at.pressure() * 1e-9, [0.5, 2.5]),
        (("radius of curvature R", "mm"), at.radius * 1e3, [5.0, 80.0]),
        (("rms roughness S", "µm"), rms(spec), [0.0, 0.6]),
    ]
    .into_iter()
    .find_map(|(name, value, range)| Outside::test(name, value, range, SOURCE))
}

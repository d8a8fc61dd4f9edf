//! Benedict and Kelley: μ = 0.0127 · 1.13/(1.13 − R_a) · log₁₀(29 700 w/(η v_s v_Σ²)).
//!
//! R_a is in µm, w in N/mm, η in mPa·s, v_s and v_Σ in m/s. The original has 50/(50 − S) and 3.17e8 for the rms
//! roughness S in µin, lbf/in, cP and in/s. In the units used here, 3.17e8 becomes 29 663.
//!
//! Source: Benedict, Kelley (1961), Instantaneous coefficients of gear tooth friction, ASLE Trans. 4, p. 59. For the
//! units used here: AGMA 925-A03, 6.2.2, which limits the roughness factor to between 1 and 3.

use super::{Conditions, Outside, ToothFrictionSpec, smooth};
use crate::numeric::Scalar;

/// Smallest argument of the logarithm: one decade. Fast, lightly loaded contacts have a full film, which the disc tests
/// did not cover. For them the formula would return negative friction.
const MIN_DECADE: f64 = 10.0;

/// Largest roughness factor in AGMA 925-A03, reached at R_a = ⅔ · 1.13 µm.
const ROUGHEST: f64 = 3.0;

/// Factor of the roughness R_a [µm].
fn roughness_factor(ra: f64) -> f64 {
    if ra < 1.13 * (1.0 - 1.0 / ROUGHEST) { 1.13 / (1.13 - ra) } else { ROUGHEST }
}

/// Argument of the logarithm.
fn argument<T: Scalar>(spec: &ToothFrictionSpec, at: &Conditions<T>) -> T {
    // 1e-3: N/m to N/mm
    at.line_load * (29_700.0 * 1e-3 / spec.centipoise()) / (at.sliding * at.sum_speed * at.sum_speed)
}

/// Coefficient at positive speeds, load and radius. With a full film it is 0.0127 times the roughness factor.
pub fn coefficient<T: Scalar>(spec: &ToothFrictionSpec, at: &Conditions<T>) -> T {
    let decades = smooth::floor(argument(spec, at), MIN_DECADE, 0.5 * MIN_DECADE).ln() * std::f64::consts::LOG10_E;
    decades * (0.0127 * roughness_factor(spec.micrometres()))
}

/// Returns the quantity outside the published range of the formula, or `None`.
pub fn outside(spec: &ToothFrictionSpec, at: &Conditions<f64>) -> Option<Outside> {
    let roughest = 1.13 * (1.0 - 1.0 / ROUGHEST);
    Outside::test(("roughness R_a", "µm"), spec.micrometres(), [0.0, roughest], "AGMA 925-A03").or_else(|| {
        let film = ("load against film 29700 w/(η v_s v_Σ²)", "1");
        let low = 1.5 * MIN_DECADE;
        Outside::test(film, argument(spec, at), [low, f64::INFINITY], "formula falls to zero at 1")
    })
}

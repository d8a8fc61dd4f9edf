//! From the load over the face to the stress of the root: K_Fβ = K_Hβ^N_F (ISO 6336-1, 7.6).
//!
//! ```text
//! N_F = (b/h)²/(1 + b/h + (b/h)²),      b/h the smaller of both gears, not below 3
//! ```
//!
//! K_Hβ is the largest load of the face over its mean. A tooth bends as a plate clamped at its root: what one section carries
//! is borne by the root over a length of about the tooth's depth h to both sides, so that the root sees a blunted load; the
//! wider the tooth against its depth, the less. ISO 10300-1 has K_Fβ = K_Hβ/K_F0 instead. Its K_F0 stands for the
//! lengthwise curvature of spiral teeth and is 1 for straight ones: each section would bend for itself.

use crate::geometry::Pair;
use crate::numeric::pow;

/// Least ratio of face width to depth in N_F.
const LEAST_RATIO: f64 = 3.0;

/// N_F at the ratio b/h of face width to tooth depth.
pub fn exponent(ratio: f64) -> f64 {
    let ratio = ratio.max(LEAST_RATIO);
    ratio * ratio / (1.0 + ratio + ratio * ratio)
}

/// N_F of the gears of `pair`, with the depth of their teeth at the mean section.
pub fn exponent_of(pair: &Pair) -> f64 {
    let width = pair.outer_cone - pair.inner_cone;
    let ratios = pair.gears.map(|gear| width / ((gear.addendum + gear.dedendum) * pair.mean_cone / pair.outer_cone));
    exponent(ratios[0].min(ratios[1]))
}

/// K_Fβ at the face load factor K_Hβ ≥ 1 with the exponent N_F.
pub fn root_factor(face_factor: f64, exponent: f64) -> f64 {
    pow(face_factor, exponent)
}

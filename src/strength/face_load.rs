//! Root stress factor from the load distribution over the face: K_Fβ = K_Hβ^N_F (ISO 6336-1, 7.6).
//!
//! ```text
//! N_F = (b/h)²/(1 + b/h + (b/h)²), b/h the smaller value of both gears, at least 3
//! ```
//!
//! K_Hβ is the ratio of the largest load on the face to the mean load. A tooth bends as a plate clamped at its root.
//! The root carries the load of one section over a length of about the tooth's depth h to both sides, so the root
//! stress varies less than the load. The wider the tooth compared with its depth, the weaker this effect. ISO 10300-1
//! has K_Fβ = K_Hβ/K_F0 instead. Its K_F0 represents the lengthwise curvature of spiral teeth and is 1 for straight
//! teeth, as if each section would bend independently.

use crate::geometry::Pair;
use crate::numeric::pow;

/// Smallest ratio of face width to depth in N_F.
const MIN_RATIO: f64 = 3.0;

/// N_F at the ratio b/h of face width to tooth depth.
pub fn exponent(ratio: f64) -> f64 {
    let ratio = ratio.max(MIN_RATIO);
    ratio * ratio / (1.0 + ratio + ratio * ratio)
}

/// N_F of the gears of `pair`, with the depth of their teeth at the mean section.
pub fn exponent_of(pair: &Pair) -> f64 {
    let width = pair.outer_cone - pair.inner_cone;
    let ratios = pair.gears.map(|gear| width / ((gear.addendum + gear.dedendum) * pair.mean_cone / pair.outer_cone));
    exponent(ratios[0].min(ratios[1]))
}

/// K_Fβ from the face load factor K_Hβ ≥ 1 and the exponent N_F.
pub fn root_factor(face_factor: f64, exponent: f64) -> f64 {
    pow(face_factor, exponent)
}

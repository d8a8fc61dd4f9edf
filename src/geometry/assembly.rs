//! Assembly of N planets, and the phase of each mesh in its tooth cycle.
//!
//! N equally spaced planets assemble if 2 z_s / N is an integer. Mesh i on the left side is then
//! h_iL = p_b frac(z_s φ_i / 2π) into its cycle (0 or half a pitch); the right side adds half a pitch for odd z_p.

use super::{GearSpec, Pair};
use crate::numeric::{TAU, frac};
use crate::problem::Problem;

/// Phases of a planet's meshes with the left and right side gear, as fractions of the base pitch: 0 or ½.
pub type Phases = [f64; 2];

/// Azimuth of planet `i` of `count` about the carrier axis [rad].
pub fn azimuth(i: usize, count: i32) -> f64 {
    TAU * i as f64 / f64::from(count)
}

/// Phases of each planet, or a validation error if they do not assemble.
pub fn phases(spec: &GearSpec) -> Result<Vec<Phases>, Problem> {
    let (n, z_s) = (spec.planet_count, spec.side_teeth);
    if 2 * z_s % n != 0 {
        let fitting: Vec<String> = (2..=4).filter(|k| 2 * z_s % k == 0).map(|k| k.to_string()).collect();
        return Err(problem!(
            "geometry.planet_count",
            "{n} equally spaced planets cannot be assembled with {z_s} side gear teeth: the assembly condition \
             2 side_teeth / planet_count = {:.4} must be an integer; planet counts that fit: {}",
            2.0 * f64::from(z_s) / f64::from(n),
            fitting.join(", ")
        ));
    }
    let odd = if spec.planet_teeth % 2 == 1 { 0.5 } else { 0.0 };
    // z_s i / n in halves of a pitch, by integers so that no rounding blurs it
    Ok((0..n)
        .map(|i| {
            let left = f64::from((2 * z_s * i / n) % 2) / 2.0;
            [left, frac(left + odd)]
        })
        .collect())
}

/// Angle between the tip cones of neighbouring planets, `count` of them, where they are nearest [rad]; negative where the
/// cones overlap. Neighbours turn in opposite directions there, so that teeth do not mesh.
pub fn between_planets(pair: &Pair, count: i32) -> f64 {
    TAU / f64::from(count) - 2.0 * pair.gears[0].tip
}

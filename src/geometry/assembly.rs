//! Assembly of N planets, and the phase of each mesh in its tooth cycle.
//!
//! N equally spaced planets can be assembled if 2 z_s / N is an integer. The phase of mesh i on the left side is h_iL =
//! p_b frac(z_s φ_i / 2π), which is 0 or half a pitch. On the right side, half a pitch is added for odd z_p.

use super::{GearSpec, Pair};
use crate::numeric::{TAU, frac};
use crate::problem::Problem;

/// Phases of a planet's meshes with the left and right side gear, as fractions of the base pitch: 0 or ½.
pub type Phases = [f64; 2];

/// Azimuth of planet `i` of `count` about the carrier axis [rad].
pub fn azimuth(i: usize, count: i32) -> f64 {
    TAU * i as f64 / f64::from(count)
}

/// Phases of each planet. Fails if the planets cannot be assembled.
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
    // z_s i / n in halves of a pitch, computed with integers to avoid rounding
    Ok((0..n)
        .map(|i| {
            let left = f64::from((2 * z_s * i / n) % 2) / 2.0;
            [left, frac(left + odd)]
        })
        .collect())
}

/// Smallest angle between the tip cones of neighbouring planets, of which there are `count` [rad]. It is negative if
/// the cones overlap. Neighbouring planets turn in opposite directions at this point, so their teeth cannot mesh.
pub fn between_planets(pair: &Pair, count: i32) -> f64 {
    TAU / f64::from(count) - 2.0 * pair.gears[0].tip
}

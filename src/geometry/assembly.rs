//! Assembly of N planets, and the phase of each mesh in its tooth cycle.
//!
//! N equally spaced planets can be assembled if 2 z_s / N is an integer. The phase of mesh i on the left side is h_iL =
//! p_b frac(z_s φ_i / 2π), which is 0 or half a pitch. On the right side, half a pitch is added for odd z_p.

use super::{GearSpec, Pair};
use crate::numeric::{TAU, frac};
use crate::problem::Problem;

/// Phases of a planet's meshes with the left and right side gear, as fractions of the base pitch: 0 or ½.
pub type Phases = [f64; 2];

/// Smallest number of teeth that a suggestion names. Fewer teeth are outside the range of `geometry.side_teeth`.
const FEWEST_TEETH: i32 = 5;

/// Azimuth of planet `i` of `count` about the carrier axis [rad].
pub fn azimuth(i: usize, count: i32) -> f64 {
    TAU * i as f64 / f64::from(count)
}

/// Phases of each planet. Fails if the planets cannot be assembled.
pub fn phases(spec: &GearSpec) -> Result<Vec<Phases>, Problem> {
    let (n, z_s) = (spec.planet_count, spec.side_teeth);
    if 2 * z_s % n != 0 {
        let fitting: Vec<String> = (2..=4).filter(|k| 2 * z_s % k == 0).map(|k| k.to_string()).collect();
        // the side gear's part of the condition: a factor 2 of n is met by 2 z_s
        let multiple = if n % 2 == 0 { n / 2 } else { n };
        let below = z_s / multiple * multiple;
        let nearest: Vec<String> =
            [below, below + multiple].iter().filter(|z| **z >= FEWEST_TEETH).map(|z| z.to_string()).collect();
        return Err(problem!(
            "geometry.planet_count",
            "{n} equally spaced planets cannot be assembled with {z_s} side gear teeth: the assembly condition \
             2 side_teeth / planet_count = {:.4} must be an integer; with {z_s} side gear teeth, planet counts that fit: \
             {}; with {n} planets, side_teeth must be a multiple of {multiple}, such as {}",
            2.0 * f64::from(z_s) / f64::from(n),
            fitting.join(", "),
            nearest.join(" or ")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_assembly_condition_names_planet_counts_and_side_teeth_that_fit() {
        let said = |planet_count, side_teeth| {
            let spec = GearSpec { planet_count, side_teeth, ..GearSpec::default() };
            phases(&spec).map_err(|problem| problem.to_string())
        };
        let three = said(3, 16).unwrap_err();
        assert!(three.contains("with 16 side gear teeth, planet counts that fit: 2, 4;"), "{three}");
        assert!(three.contains("with 3 planets, side_teeth must be a multiple of 3, such as 15 or 18"), "{three}");
        let four = said(4, 5).unwrap_err();
        assert!(four.contains("with 4 planets, side_teeth must be a multiple of 2, such as 6"), "{four}");
        for (planets, fitting) in [(3, 15), (3, 18), (4, 6), (2, 5)] {
            assert!(said(planets, fitting).is_ok());
        }
    }
}

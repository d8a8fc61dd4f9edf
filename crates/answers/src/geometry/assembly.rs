//! Orientation of the gears in the assembled differential: rotations about the common apex, which is the origin.
//!
//! x̂ is the carrier's axis. From apex to heel the left side gear points along +x̂, the right one along −x̂, and planet i
//! along r̂_i, which is ŷ turned about x̂ by 2πi/N and by the carrier's angle. Angles of carrier and side gears are positive
//! about x̂. A positive spin turns a planet about −r̂_i, so that it speeds the left side up: ω_L,R = ω_c ± (z_p/z_s) ψ̇.
//! At zero the left side gear has a gap at ŷ, with the tooth of planet 0 in its middle. All other planets and the right
//! side gear follow `geometry::assembly::phases`: they have a tooth in the middle of the gap, or half a pitch from it.

use bevel_differential::geometry::GearSpec;
use bevel_differential::geometry::assembly::{azimuth, phases};
use bevel_differential::numeric::{PI, TAU, cos, sin};
use bevel_differential::problem::Problem;
use serde::Serialize;

/// Rotation matrix by rows: turns vectors from a gear's own frame into the frame of the assembly.
pub type Rotation = [[f64; 3]; 3];

/// Positions of the rotating parts [rad].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Position {
    /// Carrier about x̂.
    pub carrier: f64,
    /// Left side gear about x̂.
    pub left: f64,
    /// Right side gear about x̂.
    pub right: f64,
    /// Every planet about −r̂_i, relative to the carrier.
    pub spin: f64,
}

impl Position {
    /// Side gears rolled along by carrier and planets, with teeth in the middle of the tooth spaces.
    pub fn rolling(spec: &GearSpec, carrier: f64, spin: f64) -> Self {
        let rolled = f64::from(spec.planet_teeth) / f64::from(spec.side_teeth) * spin;
        Self { carrier, left: carrier + rolled, right: carrier - rolled, spin }
    }
}

/// A gear of the assembly.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Body {
    /// Its name: `side_gear_left`, `side_gear_right`, `planet_1` and so on.
    pub name: String,
    /// Type of the gear: 0 planet, 1 side gear.
    pub gear: usize,
    /// Orientation of the gear.
    pub rotation: Rotation,
}

/// Returns both side gears and all planets at `position`. Fails if they cannot be assembled.
pub fn bodies(spec: &GearSpec, position: &Position) -> Result<Vec<Body>, Problem> {
    let phases = phases(spec)?;
    let half_side = PI / f64::from(spec.side_teeth);
    // the tooth of planet 0 that faces left has a tooth opposite it only if its number of teeth is even
    let right_gap = if phases[0][1] == 0.0 { half_side } else { 0.0 };
    // axes of the gears' own frames in the assembly at zero: columns x, y, z
    let left = product(&[[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &about_z(half_side));
    let right = product(&[[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]], &about_z(right_gap));
    let planet = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]];
    let mut bodies = vec![
        Body { name: "side_gear_left".into(), gear: 1, rotation: product(&about_x(position.left), &left) },
        Body { name: "side_gear_right".into(), gear: 1, rotation: product(&about_x(position.right), &right) },
    ];
    for (i, phase) in phases.iter().enumerate() {
        let turned = position.spin + phase[0] * TAU / f64::from(spec.planet_teeth);
        let around = about_x(position.carrier + azimuth(i, spec.planet_count));
        let rotation = product(&around, &product(&planet, &about_z(-turned)));
        bodies.push(Body { name: format!("planet_{}", i + 1), gear: 0, rotation });
    }
    Ok(bodies)
}

/// Applies `rotation` to `v`.
pub fn turned(rotation: &Rotation, v: [f64; 3]) -> [f64; 3] {
    rotation.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn about_x(angle: f64) -> Rotation {
    let (s, c) = (sin(angle), cos(angle));
    [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]
}

fn about_z(angle: f64) -> Rotation {
    let (s, c) = (sin(angle), cos(angle));
    [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
}

fn product(a: &Rotation, b: &Rotation) -> Rotation {
    a.map(|row| [0, 1, 2].map(|j| row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevel_differential::geometry::involute::direction;
    use bevel_differential::geometry::solid::{Outline, Part};
    use bevel_differential::geometry::{Pair, checks};

    fn transposed(r: &Rotation) -> Rotation {
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| r[j][i]))
    }

    fn scenes() -> Vec<GearSpec> {
        let teeth =
            [(10, 16, 2), (9, 14, 2), (10, 15, 3), (9, 18, 3), (11, 15, 2), (10, 16, 4), (9, 14, 4), (14, 14, 4)];
        teeth
            .map(|(planet_teeth, side_teeth, planet_count)| GearSpec {
                planet_teeth,
                side_teeth,
                planet_count,
                ..GearSpec::default()
            })
            .to_vec()
    }

    /// Polar angle of the outline `nodes` at `azimuth` within its pitch.
    fn surface(nodes: &[bevel_differential::geometry::solid::Node], azimuth: f64) -> f64 {
        let after = nodes.partition_point(|n| n.azimuth < azimuth).clamp(1, nodes.len() - 1);
        let (a, b) = (&nodes[after - 1], &nodes[after]);
        let width = b.azimuth - a.azimuth;
        let u = if width > 0.0 { (azimuth - a.azimuth) / width } else { 0.0 };
        a.polar + (b.polar - a.polar) * u.clamp(0.0, 1.0)
    }

    /// Depth of the deepest node of one body within the other [rad], and the minimum distance of their flanks [rad].
    fn clearance(
        pair: &Pair,
        outlines: &[Vec<bevel_differential::geometry::solid::Node>; 2],
        a: &Body,
        b: &Body,
    ) -> [f64; 2] {
        let back = product(&transposed(&b.rotation), &a.rotation);
        let (own, mate) = (&pair.gears[a.gear], &pair.gears[b.gear]);
        let (mut deepest, mut least) = (-1.0f64, 1.0f64);
        for tooth in 0..own.teeth {
            for node in &outlines[a.gear] {
                let d = direction(node.polar, node.azimuth + own.tooth_pitch() * f64::from(tooth));
                let [x, y, z] = turned(&back, [d.x, d.y, d.z]);
                let (polar, azimuth) = (x.hypot(y).atan2(z), y.atan2(x));
                if polar > mate.tip {
                    continue;
                }
                let azimuth = azimuth - mate.tooth_pitch() * (azimuth / mate.tooth_pitch()).round();
                deepest = deepest.max(surface(&outlines[b.gear], azimuth) - polar);
                if polar > mate.base && node.part == Part::Flank {
                    // arc along the common tangent of the base circles
                    least = least.min((azimuth.abs() - mate.half_angle(polar)) * mate.base.sin());
                }
            }
        }
        [deepest, least]
    }

    #[test]
    fn teeth_are_in_the_middle_of_gaps_at_every_spin_angle() {
        let mut seen = 0;
        for spec in scenes() {
            let pair = Pair::new(&spec);
            assert!(checks::errors(&spec, &pair).is_empty(), "{spec:?}");
            let fillet = spec.root_fillet * pair.module / pair.outer_cone;
            let outlines = [0, 1].map(|i| Outline::new(&pair.gears[i], fillet, 200).nodes);
            for (carrier, spin) in [(0.0, 0.0), (0.3, 0.1), (1.0, -0.23), (2.0, 0.31), (-0.7, 17.0)] {
                let bodies = bodies(&spec, &Position::rolling(&spec, carrier, spin)).expect("they assemble");
                assert_eq!(bodies.len(), 2 + spec.planet_count as usize);
                for planet in &bodies[2..] {
                    for side in &bodies[..2] {
                        let what = format!(
                            "{}/{} N {} {} {} at {spin}",
                            spec.planet_teeth, spec.side_teeth, spec.planet_count, planet.name, side.name
                        );
                        for [deepest, least] in
                            [clearance(&pair, &outlines, planet, side), clearance(&pair, &outlines, side, planet)]
                        {
                            assert!(deepest < 0.0, "{what}: {deepest:e}");
                            let share = least / (pair.normal_backlash / 2.0);
                            assert!((share - 1.0).abs() < 0.02, "{what}: {share} of half the backlash");
                            seen += 1;
                        }
                    }
                }
            }
        }
        assert!(seen > 300);
    }

    #[test]
    fn side_gears_that_do_not_follow_penetrate_the_planets() {
        let spec = GearSpec::default();
        let pair = Pair::new(&spec);
        let outlines = [0, 1].map(|i| Outline::new(&pair.gears[i], 0.02, 200).nodes);
        for sign in [1.0, -1.0] {
            let rolling = Position::rolling(&spec, 0.0, 0.05);
            // a little more than half the backlash
            let off = sign * 0.6 * pair.normal_backlash / pair.sin_base()[1];
            let bodies = bodies(&spec, &Position { left: rolling.left + off, ..rolling }).expect("they assemble");
            let [deepest, least] = clearance(&pair, &outlines, &bodies[2], &bodies[0]);
            assert!(deepest > 0.0 && least < 0.0, "{deepest} {least}");
        }
    }

    #[test]
    fn rotations_keep_lengths_and_axes_point_as_agreed() {
        let spec = GearSpec { planet_count: 4, ..GearSpec::default() };
        let bodies = bodies(&spec, &Position::rolling(&spec, 0.0, 0.4)).expect("they assemble");
        let axes: Vec<[f64; 3]> = bodies.iter().map(|b| turned(&b.rotation, [0.0, 0.0, 1.0])).collect();
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let wanted = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0], [0, 0, -1]];
        for ((axis, wanted), body) in axes.iter().zip(wanted).zip(&bodies) {
            assert!((0..3).all(|i| (axis[i] - f64::from(wanted[i])).abs() < 1e-15), "{}: {axis:?}", body.name);
            let unit = product(&body.rotation, &transposed(&body.rotation));
            assert!((0..9).all(|k| (unit[k / 3][k % 3] - identity[k / 3][k % 3]).abs() < 1e-15), "{unit:?}");
            let [x, y, z] = identity.map(|e| turned(&body.rotation, e));
            let right_handed = (x[1] * y[2] - x[2] * y[1]) * z[0]
                + (x[2] * y[0] - x[0] * y[2]) * z[1]
                + (x[0] * y[1] - x[1] * y[0]) * z[2];
            assert!((right_handed - 1.0).abs() < 1e-14, "{}", body.name);
        }
    }

    #[test]
    fn planets_that_do_not_fit_are_refused_by_name() {
        let spec = GearSpec { planet_count: 3, ..GearSpec::default() };
        let problem = bodies(&spec, &Position::default()).expect_err("2 · 16 / 3 is not an integer");
        assert_eq!(problem.variable, "geometry.planet_count");
    }
}

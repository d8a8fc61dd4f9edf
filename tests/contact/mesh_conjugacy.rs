//! Conjugate flanks: the flanks of both gears, turned by s/sinδ_b, meet along the great circle of action for any pair.

use crate::mesh_explicit::{V3, about, pitch_angles, random_spec};
use bevel_differential::geometry::Pair;
use fastrand::Rng;
use nalgebra::Rotation3;

const PAIRS: usize = 400;
const STEPS: i32 = 24;

#[test]
fn the_gear_law_is_valid_on_the_sphere_for_any_pair() {
    let mut random = Rng::with_seed(1);
    for _ in 0..PAIRS {
        let spec = random_spec(&mut random, false);
        let pair = Pair::new(&spec);
        let (delta, residual) = pitch_angles(&spec);
        assert!(residual.abs() < 1e-12);
        for i in 0..2 {
            assert!((pair.gears[i].pitch - delta[i]).abs() < 1e-14, "{spec:?}");
            let lever = delta[i].sin() * spec.pressure_angle.cos();
            assert!((pair.sin_base()[i] - lever).abs() < 1e-15 * 4.0, "{spec:?}");
            let from_tooth = pair.gears[i].tooth_pitch() * pair.sin_base()[i];
            assert!((pair.base_pitch / from_tooth - 1.0).abs() < 1e-14, "{spec:?}");
        }
        let [z_p, z_s] = [spec.planet_teeth, spec.side_teeth].map(f64::from);
        let law = z_p * pair.sin_base()[1] / (z_s * pair.sin_base()[0]) - 1.0;
        assert!(law.abs() < 1e-14, "z_p sinδ_bs = z_s sinδ_bp is off by {law:e} for {spec:?}");
    }
}

#[test]
fn the_line_of_action_touches_both_base_circles_at_the_arcs_psi() {
    let mut random = Rng::with_seed(2);
    for _ in 0..PAIRS {
        let spec = random_spec(&mut random, false);
        let pair = Pair::new(&spec);
        let (start, tangent, axes) = line_of_action(&spec.pressure_angle, &pair);
        for (i, hand) in [(0, -1.0), (1, 1.0)] {
            // the great circle touches a gear's base circle at its point nearest to the gear's axis
            let along = (tangent.dot(&axes[i])).atan2(start.dot(&axes[i]));
            assert!((along - hand * pair.pitch_arc[i]).abs() < 1e-14, "{spec:?}: {along} {}", pair.pitch_arc[i]);
            let foot = start * along.cos() + tangent * along.sin();
            let base = foot.cross(&axes[i]).norm().atan2(foot.dot(&axes[i]));
            assert!((base - pair.gears[i].base).abs() < 4e-15, "{spec:?}");
        }
        let arcs = pair.pitch_arc[0] + pair.pitch_arc[1];
        assert!((pair.line_of_action() - arcs).abs() < 1e-15);
        assert!(pair.path.low >= -pair.pitch_arc[0] && pair.path.high <= pair.pitch_arc[1]);
    }
}

/// Pitch point, unit tangent of the line of action toward the planet's tip, and the axes of planet and side gear.
///
/// Frame: planet axis z, side gear axis in the xz plane at Σ, with the pitch line between them. At the pitch point, the
/// normal is inclined by α to the direction y of motion, away from the planet's axis and toward the side gear's axis.
fn line_of_action(pressure: &f64, pair: &Pair) -> (V3, V3, [V3; 2]) {
    let axes = [V3::z(), V3::new(pair.shaft_angle.sin(), 0.0, pair.shaft_angle.cos())];
    let pitch = pair.gears[0].pitch;
    let start = V3::new(pitch.sin(), 0.0, pitch.cos());
    let outward = V3::y().cross(&start);
    assert!(outward.dot(&axes[1]) > 0.0 && outward.dot(&axes[0]) < 0.0);
    (start, V3::y() * pressure.cos() + outward * pressure.sin(), axes)
}

#[test]
fn rotated_flanks_of_random_pairs_coincide_along_the_path_with_common_normals() {
    let mut random = Rng::with_seed(3);
    let (mut worst_point, mut worst_normal, mut worst_lever) = (0.0f64, 0.0f64, 0.0f64);
    for _ in 0..PAIRS {
        let spec = random_spec(&mut random, false);
        let pair = Pair::new(&spec);
        let [planet, side] = &pair.gears;
        let (start, tangent, axes) = line_of_action(&spec.pressure_angle, &pair);
        // the side gear's own frame: z along its axis, x toward the planet's axis
        let toward = V3::y().cross(&axes[1]) * -1.0;
        let side_frame = Rotation3::from_basis_unchecked(&[toward, axes[1].cross(&toward), axes[1]]);
        for k in 0..=STEPS {
            let s = pair.path.low + (pair.path.high - pair.path.low) * f64::from(k) / f64::from(STEPS);
            // both gears turn so that their flanks move along y in the mesh; the side gear's own azimuth is opposite
            let on_planet = about(V3::z(), s / pair.sin_base()[0] - planet.half_pitch);
            let on_side = side_frame * about(V3::z(), -s / pair.sin_base()[1] - side.half_pitch);
            let polar = [planet.polar_at(pair.pitch_arc[0] + s), side.polar_at(pair.pitch_arc[1] - s)];
            let expected = start * s.cos() + tangent * s.sin();
            let p = on_planet * planet.flank_point(polar[0], 1.0);
            let q = on_side * side.flank_point(polar[1], 1.0);
            // 2e-15 rad is nine units in the last place of 1, because inv(δ) − inv(φ) and s/sinδ_b cancel
            let residual = (p - expected).norm().max((q - expected).norm()).max((p - q).norm());
            worst_point = worst_point.max(residual);
            assert!(residual <= 2e-15, "{spec:?} at {s}: {residual:e}");
            let turned = tangent * s.cos() - start * s.sin();
            let normals = [on_planet * planet.flank_normal(polar[0], 1.0), on_side * side.flank_normal(polar[1], 1.0)];
            let arcs = [pair.pitch_arc[0] + s, pair.pitch_arc[1] - s];
            for (i, hand) in [(0, 1.0), (1, -1.0)] {
                // the last bit of the polar angle turns the normal by ε/ψ near the base circle, at most √ε on it
                let allowed = (4e-15 / arcs[i].abs().max(1e-15)).clamp(4e-15, 1e-7);
                let off = (normals[i] - turned * hand).norm();
                worst_normal = worst_normal.max(off * arcs[i].abs().min(1.0));
                assert!(off < allowed, "{spec:?} at {s}, gear {i}: normal off {off:e}");
                let lever = (expected.cross(&turned).dot(&axes[i])).abs();
                worst_lever = worst_lever.max((lever - pair.sin_base()[i]).abs());
                assert!((lever - pair.sin_base()[i]).abs() < 1e-14, "{spec:?} at {s}, gear {i}: lever {lever}");
            }
        }
    }
    println!("worst point {worst_point:e} rad, normal {worst_normal:e}/ψ, lever {worst_lever:e}");
}

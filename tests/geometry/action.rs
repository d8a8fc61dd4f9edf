//! Contact as vectors: on the path, at tip corners, and in the frames of the gears.

use bevel_differential::geometry::GearSpec;
use bevel_differential::geometry::action::*;
use bevel_differential::geometry::corner::CornerGap;
use bevel_differential::geometry::pair::Pair;
use nalgebra::Vector3;

fn golden() -> Vec<[f64; 11]> {
    include_str!("../data/golden_contact_path_B.csv")
        .lines()
        .filter(|line| !line.starts_with(['#', 's']))
        .map(|line| {
            let values: Vec<f64> = line.split(',').map(|x| x.parse().expect("a number")).collect();
            values.try_into().expect("eleven columns")
        })
        .collect()
}

/// Axis of gear `i` from apex to heel: the planet's axis is z, the side gear's axis is in the plane of z and x.
fn axis(pair: &Pair, i: usize) -> Vector3<f64> {
    let angle = if i == 0 { 0.0 } else { pair.shaft_angle };
    Vector3::new(angle.sin(), 0.0, angle.cos())
}

fn default_pair() -> Pair {
    Pair::new(&GearSpec { backlash: 0.0, ..GearSpec::default() })
}

#[test]
fn points_and_normals_match_the_golden_ones_and_their_mirror_images() {
    let pair = default_pair();
    let action = LineOfAction::new(&pair);
    let rows = golden();
    assert!(rows.len() > 10);
    for [s, phi1, phi2, cx, cy, cz, tx, ty, tz, theta1, theta2] in rows {
        for turn in [1.0, -1.0] {
            let contact = action.contact(Spot::Path, s.to_radians(), turn);
            let point = contact.point * pair.outer_cone * 1e3;
            assert!((point - Vector3::new(cx, turn * cy, cz)).amax() < 1e-9, "{s}");
            assert!((contact.normal - Vector3::new(tx, turn * ty, tz)).amax() < 1e-10, "{s}");
            // the flanks contain the point after the rotations in the table, with teeth in mid-gap at the pitch point
            for (i, theta, polar) in [(0, theta1, phi1), (1, theta2, phi2)] {
                let axis = axis(&pair, i);
                assert!((contact.point.dot(&axis) - polar.to_radians().cos()).abs() < 1e-10);
                let turned = action.rotation(&contact, i, -turn * pair.gears[i].half_pitch, turn);
                let wanted = if i == 0 { turn * theta } else { -turn * theta };
                assert!((turned - wanted.to_radians()).abs() < 1e-9, "{i} {turned} {theta}");
            }
        }
    }
}

#[test]
fn corners_continue_the_path_and_their_normals_have_the_moment_arms_of_the_gap() {
    for (z_p, z_s) in [(10, 16), (9, 14), (14, 14)] {
        let pair = Pair::new(&GearSpec { planet_teeth: z_p, side_teeth: z_s, ..GearSpec::default() });
        let action = LineOfAction::new(&pair);
        let corner = [0, 1].map(|i| CornerGap::new(&pair, i, 0.1));
        for turn in [1.0, -1.0] {
            let ends = [corner[0].end, -corner[1].end];
            let corners = [Spot::PlanetTip, Spot::SideTip];
            for i in 0..2 {
                let (end, start) = (action.contact(Spot::Path, ends[i], turn), action.contact(corners[i], 0.0, turn));
                assert!((end.point - start.point).amax() < 1e-12);
                assert!((end.normal - start.normal).amax() < 1e-9, "{end:?} {start:?}");
                for delta in [0.005, 0.02, 0.04] {
                    let contact = action.contact(corners[i], delta, turn);
                    assert!((contact.normal.norm() - 1.0).abs() < 1e-13);
                    assert!(contact.normal.dot(&contact.point).abs() < 1e-13);
                    // virtual work: about its own axis, the corner has the lever sinδ_b (1 − g′), about its mate's axis
                    // sinδ_b
                    let slope = corner[i].exact(delta).gap.d;
                    for k in 0..2 {
                        let axis = axis(&pair, k);
                        let sign = if k == 0 { turn } else { -turn };
                        let lever = contact.point.cross(&contact.normal).dot(&axis) * sign;
                        let wanted = pair.sin_base()[k] * if k == i { 1.0 - slope } else { 1.0 };
                        assert!((lever - wanted).abs() < 1e-12, "{z_p}/{z_s} corner {i} gear {k}: {lever} {wanted}");
                    }
                }
            }
        }
    }
}

#[test]
fn contacts_are_on_the_flanks_in_the_gears_own_frames() {
    let pair = default_pair();
    let action = LineOfAction::new(&pair);
    for turn in [1.0, -1.0] {
        for s in [-0.1, 0.0, 0.12] {
            let contact = action.contact(Spot::Path, s, turn);
            for (i, outward) in [(0, 1.0), (1, -1.0)] {
                let gear = &pair.gears[i];
                let own = action.in_gear(&contact, i, 0.0, turn);
                let polar = libm::acos(own.point.z);
                assert!((own.point - gear.flank_point(polar, turn)).amax() < 1e-13);
                assert!((own.normal * outward - gear.flank_normal(polar, turn)).amax() < 1e-12);
                // toward the planet's root and the side gear's tip
                assert!(own.along.z * outward > 0.0);
            }
        }
    }
}

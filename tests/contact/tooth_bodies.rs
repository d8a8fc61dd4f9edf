//! Tooth pairs on elastic bodies, compared with 3-D finite elements: single pairs, and two pairs that share a rotation.

use crate::golden_pairs::{FILLET, sets};
use crate::stiffness_pairs::{LINE_LOAD, PER_MM_UM, STEEL, buildable, random_pairs, stiffness};
use bevel_differential::contact::bodies::{MeshOnBodies, Support};
use bevel_differential::contact::stiffness::{PairStiffness, RootSpec};
use bevel_differential::geometry::{GearSpec, Pair};

#[test]
fn pairs_on_their_supports_match_the_stiffness_of_3d_finite_elements() {
    let sets = sets();
    assert_eq!(sets.len(), 8);
    for set in sets {
        let free = stiffness(&set.spec, FILLET);
        let mesh = MeshOnBodies::new(&Pair::new(&set.spec), &free.teeth, set.supports, 1).expect("bodies");
        let reference = LINE_LOAD / Pair::new(&set.spec).mean_cone;
        println!("{}", set.name);
        let mut mean = 0.0;
        for &[s, planet, side, _, c] in &set.single {
            let alone = mesh.alone(s, reference);
            let [q1, q2] = alone.gear.map(|q| q * PER_MM_UM);
            let ratio = alone.stiffness() / PER_MM_UM / c;
            let off = |x: f64| 100.0 * (x - 1.0);
            println!(
                "  s {:7.3}°: q planet {:+.1} %, side {:+.1} %, c {:+.1} %",
                s.to_degrees(),
                off(q1 / planet),
                off(q2 / side),
                off(ratio)
            );
            assert!((ratio - 1.0).abs() < 0.07, "{} at {s}: {ratio}", set.name);
            mean += ratio / set.single.len() as f64;
        }
        println!("  mean c {:+.1} %", 100.0 * (mean - 1.0));
        assert!((mean - 1.0).abs() < 0.04, "{}: {mean}", set.name);
        for &[s, c_sum, c_free] in &set.double {
            let [both, apart] = mesh.two_pairs(s, reference).map(|c| c / PER_MM_UM);
            let points = 100.0 * (both / apart - c_sum / c_free);
            println!(
                "  two s {:7.3}°: {:+.1} %, ratio {points:+.1} points",
                s.to_degrees(),
                100.0 * (both / c_sum - 1.0)
            );
            assert!((both / c_sum - 1.0).abs() < 0.06, "{} at {s}: {both} for {c_sum}", set.name);
            assert!(points.abs() < 3.0, "{} at {s}: {points}", set.name);
        }
    }
}

#[test]
fn compliances_of_any_gears_are_symmetric_and_positive() {
    let (mut seen, mut pairs) = (0, [0; 3]);
    for spec in random_pairs(16).filter(buildable).take(60) {
        let pair = Pair::new(&spec);
        let Ok(free) = PairStiffness::new(&pair, &RootSpec { fillet: 0.3 }, STEEL.young, STEEL.poisson, LINE_LOAD)
        else {
            continue;
        };
        // bores of half the diameter of the root circle at the toe
        let bores = [0, 1].map(|i| Support::Bore(pair.inner_cone * pair.gears[i].root.sin()));
        for supports in [
            [Support::NearRoot; 2],
            bores,
            bores.map(|bore| match bore {
                Support::Bore(diameter) => Support::FreeBore(diameter),
                other => other,
            }),
        ] {
            // some toes are so slender that these bores leave no body
            let Ok(mesh) = MeshOnBodies::new(&pair, &free.teeth, supports, 1) else { continue };
            let reference = LINE_LOAD / pair.mean_cone;
            let [low, high] = free.range;
            for k in 0..=8 {
                let s = low + (high - low) * f64::from(k) / 8.1;
                // the compliance of pairs on the path is positive
                let places = [0.0, 1.0, 2.0].map(|k| s + k * pair.base_pitch);
                let alone = places.map(|s| mesh.alone(s.min(high), reference).total());
                let [near, far] = [1, 2].map(|further| mesh.coupling(s, further));
                let next = mesh.coupling(places[1], 1);
                let minor = alone[0] * alone[1] - near * near;
                let determinant = alone[0] * (alone[1] * alone[2] - next * next)
                    - near * (near * alone[2] - next * far)
                    + far * (near * next - alone[1] * far);
                let on_path = places.iter().filter(|&&s| s <= high).count();
                pairs[on_path - 1] += 1;
                let positive = [alone[0] > 0.0, minor > 0.0, determinant > 0.0];
                assert!(positive[..on_path].iter().all(|&p| p), "{spec:?} {supports:?} at {s}");
            }
            for body in &mesh.bodies {
                for angle in [0.0, 0.3, 1.0, 3.0] {
                    let (there, back) = (body.compliance_between(angle), body.compliance_between(-angle));
                    for i in 0..3 {
                        for j in 0..3 {
                            let scale =
                                (body.compliance_between(0.0)[i][i] * body.compliance_between(0.0)[j][j]).sqrt();
                            assert!((there[i][j] - back[j][i]).abs() < 1e-9 * scale, "{spec:?} at {angle}");
                        }
                    }
                }
            }
            seen += 1;
        }
    }
    assert!(seen >= 90 && pairs[1] > 100, "{seen} {pairs:?}");
}

#[test]
fn a_bore_that_leaves_no_body_is_refused_by_name() {
    let pair = Pair::new(&GearSpec::default());
    let teeth = stiffness(&GearSpec::default(), FILLET).teeth;
    let problem = MeshOnBodies::new(&pair, &teeth, [Support::NearRoot, Support::Bore(0.06)], 1).expect_err("no body");
    assert_eq!(problem.variable, "geometry.side_bore");
    assert!(problem.to_string().contains("60.000 mm"), "{problem}");
}

#[test]
fn a_deeper_support_and_a_narrower_face_are_softer() {
    let spec = GearSpec::default();
    let reference = LINE_LOAD / Pair::new(&spec).mean_cone;
    let soft = |spec: &GearSpec, supports: [Support; 2]| {
        let mesh = MeshOnBodies::new(&Pair::new(spec), &stiffness(spec, FILLET).teeth, supports, 1).expect("bodies");
        mesh.alone(0.0, reference).total()
    };
    let bores = [6e-3, 12e-3, 20e-3, 28e-3].map(|side| soft(&spec, [Support::NearRoot, Support::Bore(side)]));
    assert!(bores.is_sorted_by(|a, b| a > b), "{bores:?}");
    let faces = [20e-3, 12e-3, 6e-3].map(|face_width| soft(&GearSpec { face_width, ..spec }, [Support::NearRoot; 2]));
    assert!(faces.is_sorted_by(|a, b| a < b), "{faces:?}");
}

/// Compliance of gear `i` of the default pair under a load at the pitch point, held by `support` [1/Pa].
fn held(i: usize, support: Support) -> f64 {
    let (spec, mut supports) = (GearSpec::default(), [Support::NearRoot; 2]);
    supports[i] = support;
    let teeth = stiffness(&spec, FILLET).teeth;
    MeshOnBodies::new(&Pair::new(&spec), &teeth, supports, 1).expect("bodies").gear(i, teeth.rolls(0.0)[i])
}

#[test]
fn compliance_is_continuous_in_the_bore_and_wider_bores_are_stiffer() {
    let pair = Pair::new(&GearSpec::default());
    for i in 0..2 {
        let widest = Support::widest(&pair, i);
        for support in [Support::Bore, Support::FreeBore] {
            let mut last = f64::INFINITY;
            for k in 1..=60 {
                let d = widest * (f64::from(k) / 60.0 - 1e-6);
                let [before, here] = [1.0 - 1e-6, 1.0].map(|part| held(i, support(part * d)));
                assert!((before / here - 1.0).abs() < 1e-5, "gear {i} at {d}: {before:e} {here:e}");
                // a bore without torque has hardly any influence
                let is_free = support(0.0) == Support::FreeBore(0.0);
                assert!(is_free || here < last, "gear {i} at {d}: {here:e} after {last:e}");
                last = here;
            }
        }
    }
}

#[test]
fn torque_through_a_bore_turns_the_gear_like_an_annulus() {
    // θ = T/(4πGb) (4/d² − …), T = ω sin δ_b ∫R²dR, and the arc of the flank is θ sin δ_b
    let pair = Pair::new(&GearSpec::default());
    let (width, shear) = (pair.outer_cone - pair.inner_cone, 0.5 * STEEL.young / (1.0 + STEEL.poisson));
    let moment = (pair.outer_cone.powi(3) - pair.inner_cone.powi(3)) / 3.0;
    for i in 0..2 {
        let arm = pair.gears[i].base.sin();
        let turned = |d: f64| arm * arm * moment / (std::f64::consts::PI * shear * width * d * d);
        // difference between a bore with and without torque; elements are coarse around the narrowest bore
        let by_torque = |d: f64| held(i, Support::Bore(d)) - held(i, Support::FreeBore(d));
        for (part, within) in [(0.2, 0.05), (0.1, 0.1), (0.05, 0.2), (0.02, 0.2)] {
            let [narrow, wide] = [0.75, 1.25].map(|share| share * part * pair.outer_cone);
            let (found, expected) = (by_torque(narrow) - by_torque(wide), turned(narrow) - turned(wide));
            println!("gear {i}, {:.2} and {:.2} mm: {:.3}", narrow * 1e3, wide * 1e3, found / expected);
            assert!((found / expected - 1.0).abs() < within, "gear {i} at {part}: {found:e} {expected:e}");
        }
    }
}

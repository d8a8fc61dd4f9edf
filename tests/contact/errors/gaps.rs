//! Gaps of tooth pairs with all errors, checked against the definition of each error.

use crate::tooth_errors::every_kind;
use bevel_differential::contact::errors::pitch::Tolerances;
use bevel_differential::contact::errors::*;
use bevel_differential::contact::pairs::Flank;
use bevel_differential::geometry::{GearSpec, Pair};

const LEFT: MeshId = MeshId { planet: 0, side: 0 };
const RIGHT: MeshId = MeshId { planet: 0, side: 1 };

fn pair() -> Pair {
    Pair::new(&GearSpec::default())
}

fn errors(spec: ToothErrorSpec, planets: usize) -> ToothErrors {
    ToothErrors::new(&spec, &pair(), planets).unwrap()
}

fn id(flank: Flank) -> PairId {
    PairId { planet_tooth: 4, side_tooth: 7, flank }
}

#[test]
fn error_free_teeth_have_no_gap() {
    let perfect = errors(ToothErrorSpec::default(), 2);
    assert!(perfect.is_uniform_over_face() && !perfect.is_individual());
    for s in [-0.3, 0.0, 0.2] {
        assert_eq!(perfect.gap(LEFT, id(Flank::Drive), 0.03, s), 0.0);
    }
}

#[test]
fn errors_add_up_and_report_whether_they_are_uniform_or_individual() {
    let none = ToothErrorSpec::default();
    let a = every_kind();
    let parts = [
        (ToothErrorSpec { accuracy_grade: 7, seed: 11, ..none }, true, true),
        (
            ToothErrorSpec {
                seed: 11,
                planet_runout: Tolerances::of_gear(7, &pair(), 0).runout,
                side_runout: Tolerances::of_gear(7, &pair(), 1).runout,
                ..none
            },
            false,
            true,
        ),
        (ToothErrorSpec { planet_tip_relief: a.planet_tip_relief, ..none }, false, false),
        (ToothErrorSpec { side_tip_relief: a.side_tip_relief, ..none }, false, false),
        (ToothErrorSpec { crowning: a.crowning, ..none }, false, false),
        (ToothErrorSpec { shaft_angle_error: a.shaft_angle_error, ..none }, true, false),
        (ToothErrorSpec { planet_axial_offset: a.planet_axial_offset, ..none }, false, false),
        (ToothErrorSpec { side_axial_offset: a.side_axial_offset, ..none }, false, false),
        (ToothErrorSpec { axis_offset: a.axis_offset, ..none }, false, true),
    ];
    for (spec, uniform, individual) in parts {
        let part = errors(spec, 2);
        assert_eq!((part.is_uniform_over_face(), part.is_individual()), (uniform, individual), "{spec:?}");
    }
    let whole = errors(a, 2);
    for planet in 0..2 {
        for side in 0..2 {
            for (r, s) in [(0.025, -0.17), (0.034, 0.03), (0.042, 0.2)] {
                let mesh = MeshId { planet, side };
                let sum: f64 = parts.iter().map(|p| errors(p.0, 2).gap(mesh, id(Flank::Coast), r, s)).sum();
                assert!((whole.gap(mesh, id(Flank::Coast), r, s) - sum).abs() < 1e-18);
            }
        }
    }
}

#[test]
fn pitch_deviations_are_per_tooth_and_grow_with_r() {
    let graded = errors(ToothErrorSpec { accuracy_grade: 7, ..ToothErrorSpec::default() }, 2);
    let (mean, half) = (pair().mean_cone, 0.5 * pair().mean_cone);
    let e = graded.gap(LEFT, id(Flank::Drive), mean, 0.1);
    assert!(e != 0.0 && (graded.gap(LEFT, id(Flank::Drive), half, 0.1) - 0.5 * e).abs() < 1e-20);
    let tooth = |j, flank| graded.gap(LEFT, PairId { planet_tooth: j, side_tooth: 0, flank }, mean, -0.2);
    assert_ne!(tooth(0, Flank::Drive), tooth(1, Flank::Drive));
    assert_eq!(tooth(0, Flank::Drive), tooth(10, Flank::Drive));
    // the largest step from one tooth to the next is f_ptT along the line of action
    let step = (0..10).map(|j| (tooth(j + 1, Flank::Coast) - tooth(j, Flank::Coast)).abs()).fold(0.0, f64::max);
    let pair = pair();
    let along = 2.0 * pair.mean_cone * pair.sin_base()[0] / pitch::tolerance_diameter(&pair, 0);
    assert!((step - Tolerances::of_gear(7, &pair, 0).single_pitch * along).abs() < 1e-18);
}

#[test]
fn misalignment_follows_its_closed_forms() {
    let p = pair();
    let (sa, ca) = p.pressure_angle.sin_cos();
    let [(sp, cp), (ss, cs)] = p.gears.map(|g| g.pitch.sin_cos());
    let none = ToothErrorSpec::default();
    let e = 10e-6;
    for s in [-0.18, 0.0, 0.07, 0.25] {
        let (sin, cos) = f64::sin_cos(s);
        for (flank, sign) in [(Flank::Drive, 1.0), (Flank::Coast, -1.0)] {
            let gap = |spec, mesh| errors(spec, 2).gap(mesh, id(flank), 0.03, s);
            let is = |spec, left: f64, right: f64| {
                assert!((gap(spec, LEFT) - left).abs() < 1e-19 && (gap(spec, RIGHT) - right).abs() < 1e-19);
            };
            let planet = e * (sa * sp * cos + cp * sin);
            is(ToothErrorSpec { planet_axial_offset: e, ..none }, planet, planet);
            let side = e * (sa * ss * cos - cs * sin);
            is(ToothErrorSpec { side_axial_offset: e, ..none }, side, side);
            let across = -sign * e * ca * cos;
            is(ToothErrorSpec { axis_offset: e, ..none }, across, across);
            let opposite = MeshId { planet: 1, side: 0 };
            assert!((gap(ToothErrorSpec { axis_offset: e, ..none }, opposite) + across).abs() < 1e-19);
            is(ToothErrorSpec { shaft_angle_error: 1e-4, ..none }, 0.03 * sa * 1e-4, -0.03 * sa * 1e-4);
        }
    }
    // the axis of the second of four planets is along the displacement
    let four = errors(ToothErrorSpec { axis_offset: e, ..none }, 4);
    let second = four.gap(MeshId { planet: 1, side: 0 }, id(Flank::Drive), 0.03, 0.0);
    assert!((second - e * sa * sp).abs() < 1e-19);
}

#[test]
fn runout_is_one_wave_per_revolution_with_the_eccentricity_as_amplitude() {
    let p = pair();
    for (gear, spec) in [
        (0, ToothErrorSpec { planet_runout: 40e-6, ..ToothErrorSpec::default() }),
        (1, ToothErrorSpec { side_runout: 40e-6, ..ToothErrorSpec::default() }),
    ] {
        let teeth = p.gears[gear].teeth as usize;
        let (pitch, base) = (p.gears[gear].pitch, p.gears[gear].base);
        let off = errors(spec, 2);
        for flank in [Flank::Drive, Flank::Coast] {
            let at = |j: usize, s: f64| off.gap(LEFT, PairId { planet_tooth: j, side_tooth: j, flank }, 0.03, s);
            let (mut mean, mut square) = (0.0, 0.0);
            for j in 0..teeth {
                mean += at(j, 0.0) / teeth as f64;
                square += at(j, 0.0).powi(2) / teeth as f64;
            }
            // at the pitch point, the normal is inclined by sinα sinδ to the plane of rotation
            let amplitude = 20e-6 * (1.0 - (p.pressure_angle.sin() * pitch.sin()).powi(2)).sqrt();
            assert!(mean.abs() < 1e-19 && (square - amplitude * amplitude / 2.0).abs() < 1e-20);
            assert!((base.sin() - p.sin_base()[gear]).abs() < 1e-15);
        }
    }
}

#[test]
fn two_pairs_in_contact_at_the_same_time_have_nearly_the_same_runout() {
    let p = pair();
    let off = errors(ToothErrorSpec { planet_runout: 40e-6, side_runout: 40e-6, seed: 5, ..Default::default() }, 2);
    for planet_tooth in 0..10 {
        for (mesh, planet_next) in [(LEFT, planet_tooth + 1), (RIGHT, planet_tooth + 9)] {
            for (flank, next, back) in
                [(Flank::Drive, planet_next, 1), (Flank::Coast, 2 * planet_tooth + 20 - planet_next, 15)]
            {
                // the pair one base pitch further along the path is one tooth further along t (drive) or against t
                // (coast)
                let here = PairId { planet_tooth, side_tooth: 3, flank };
                let there = PairId { planet_tooth: next, side_tooth: 3 + back, flank };
                let s = -0.5 * p.base_pitch;
                let (a, b) = (off.gap(mesh, here, 0.03, s), off.gap(mesh, there, 0.03, s + p.base_pitch));
                // only the normal has turned, by one base pitch
                assert!((a - b).abs() < 2.0 * 20e-6 * p.base_pitch, "{a} {b}");
            }
        }
    }
}

#[test]
fn openings_have_exact_derivatives_with_respect_to_s() {
    let whole = errors(every_kind(), 4);
    for planet in 0..4 {
        for side in 0..2 {
            for flank in [Flank::Drive, Flank::Coast] {
                for k in -20..=20 {
                    let (mesh, s, h) = (MeshId { planet, side }, 0.0123 * f64::from(k), 1e-6);
                    let at = |s| whole.opening(mesh, id(flank), s).even;
                    let (m, c, p) = (at(s - h), at(s), at(s + h));
                    assert!((c.d - (p.v - m.v) / (2.0 * h)).abs() < 1e-8, "{s} {c:?}");
                    assert!((c.dd - (p.d - m.d) / (2.0 * h)).abs() < 1e-5, "{s} {c:?} {m:?} {p:?}");
                }
            }
        }
    }
}

#[test]
fn any_index_and_position_give_a_finite_gap() {
    let whole = errors(every_kind(), 3);
    for k in [0, 1, 17, 1_000_003, usize::MAX] {
        let mesh = MeshId { planet: k, side: k };
        for s in [-1e6, -1.0, 0.0, 1.0, 1e6] {
            let pair = PairId { planet_tooth: k, side_tooth: k, flank: Flank::Drive };
            assert!(whole.gap(mesh, pair, 0.03, s).is_finite());
        }
    }
    assert!(ToothErrors::new(&every_kind(), &pair(), 0).is_err());
}

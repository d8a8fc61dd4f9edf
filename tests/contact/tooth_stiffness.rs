//! Tooth stiffness from geometry, compared with 3-D finite elements, ISO 6336-1 and an independent prototype.

use crate::stiffness_pairs::{PER_MM_UM, default, golden, golden_spec};
use bevel_differential::contact::stiffness::{Elasticity, SectionPair, SectionSpec};
use bevel_differential::geometry::{GearSpec, Pair};

/// Relative difference of `found` from `expected`, which is also printed.
fn off(what: &str, found: f64, expected: f64) -> f64 {
    let off = found / expected - 1.0;
    println!("{what}: {found:.4}, expected {expected}: {:+.2} %", 100.0 * off);
    off
}

#[test]
fn stiffness_along_the_path_agrees_with_finite_elements() {
    let (stiffness, spec) = (golden(), golden_spec());
    let path = Pair::new(&spec).path;
    let mut worst = 0f64;
    let mut places = 0;
    let rows = include_str!("../data/golden_fe3d_B.csv").lines().filter(|l| !l.starts_with('#') && !l.starts_with('s'));
    for row in rows {
        let columns: Vec<f64> = row.split(',').map(|v| v.parse().expect("a number")).collect();
        let s = columns[0].to_radians();
        if s > path.low && s < path.high {
            places += 1;
            let difference = off(&format!("c({:.3}°)", columns[0]), stiffness.at(s) / PER_MM_UM, columns[4]);
            worst = worst.max(difference.abs());
        }
    }
    println!("worst of {places}: {:.2} %", 100.0 * worst);
    assert!(places >= 16 && worst < 0.10);
    assert!(off("mesh mean", stiffness.mesh_mean() / PER_MM_UM, 16.8).abs() < 0.08);
}

#[test]
fn the_default_root_matches_its_reference_values() {
    let stiffness = default();
    let path = Pair::new(&GearSpec::default()).path;
    let largest = (0..=1000).map(|j| stiffness.at(path.low + (path.high - path.low) * f64::from(j) / 1000.0));
    assert!(off("largest", largest.fold(0.0, f64::max) / PER_MM_UM, 14.4).abs() < 0.10);
    assert!(off("at pitch", stiffness.at(0.0) / PER_MM_UM, 13.8).abs() < 0.10);
    assert!(off("mesh mean", stiffness.mesh_mean() / PER_MM_UM, 18.7).abs() < 0.10);
}

/// ISO 6336-1's c'_th [N/(mm·µm)] without profile shift: 1/q'.
fn iso_stiffness(z: [f64; 2]) -> f64 {
    1.0 / (0.04723 + 0.15551 / z[0] + 0.25791 / z[1])
}

#[test]
fn spur_gears_have_the_theoretical_single_stiffness_of_iso_6336() {
    let m = 4.5e-3;
    for (z, printed) in [([20.0, 40.0], 16.27), ([30.0, 30.0], 16.39), ([50.0, 50.0], 18.02)] {
        let iso = iso_stiffness(z);
        assert!((iso - printed).abs() < 0.005, "{iso}");
        let section = |teeth: f64| {
            let alpha = 20f64.to_radians();
            SectionSpec { module: m, teeth, pressure_angle: alpha, profile_shift: 0.0, addendum: m, dedendum: 1.25 * m }
                .generated(0.38 * m)
        };
        let teeth = SectionPair { sections: z.map(section), elasticity: Elasticity { young: 2.06e11, poisson: 0.3 } };
        let [first, second] =
            teeth.sections.each_ref().map(|s| (s.tip_radius.powi(2) - s.base_radius.powi(2)).sqrt() - s.pitch_roll);
        let places = (0..=400).map(|j| -second + (first + second) * f64::from(j) / 400.0);
        let largest = places.map(|place| teeth.at(place, 300e3).stiffness()).fold(0.0, f64::max);
        assert!(off(&format!("spur {z:?}"), largest / PER_MM_UM, iso).abs() < 0.08);
    }
}

#[test]
fn sections_and_compliances_equal_those_of_an_independent_prototype() {
    // 1e-12/Pa = 1e-3 mm²/N; lengths in mm; half a unit of the last printed digit
    let (golden, default) = (golden(), default());
    let near = |found: f64, printed: f64, digits: i32| {
        assert!((found - printed).abs() <= 0.51 * 10f64.powi(-digits), "{found} is not {printed}");
    };
    let roots =
        [(&golden, [[21.6651, 9.4043], [60.8514, 9.5459]]), (&default, [[21.7572, 10.6425], [61.0263, 10.8573]])];
    for (stiffness, roots) in roots {
        for (tooth, [height, chord]) in stiffness.teeth.sections.iter().zip(roots) {
            near(tooth.root_height * 1e3, height, 4);
            near(tooth.root_chord * 1e3, chord, 4);
        }
    }
    let cases = [
        (&golden, 0.0, [0.02151, 0.03827], 12.571),
        (&golden, -8.5, [0.01946, 0.06576], 9.357),
        (&golden, 9.4293, [0.03626, 0.02460], 12.555),
        (&default, 0.0, [0.01930, 0.03316], 13.843),
    ];
    for (stiffness, degrees, gear, c) in cases {
        let exact = stiffness.exact(f64::to_radians(degrees), stiffness.reference);
        near(exact.gear[0] * 1e9, gear[0], 5);
        near(exact.gear[1] * 1e9, gear[1], 5);
        near(exact.stiffness() / PER_MM_UM, c, 3);
    }
    let pitch = golden.exact(0.0, golden.reference);
    near(pitch.half_width * 1e3, 0.1984, 4);
    near(pitch.hertz * 1e9, 0.01977, 5);
    let [planet, side] = [0, 1].map(|i| golden.teeth.sections[i].load(golden.teeth.rolls(0.0)[i]));
    for (load, [cosine, height, depth]) in [(planet, [0.98035, 25.4326, 4.0581]), (side, [0.95421, 66.8913, 3.2217])] {
        near(load.angle.cos(), cosine, 5);
        near(load.height * 1e3, height, 4);
        near(load.depth * 1e3, depth, 4);
    }
}

//! Loads on the root of a tooth, spread over patches.

use bevel_differential::contact::bodies::*;
use bevel_differential::contact::stiffness::SectionSpec;
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::numeric::{TAU, asin, cos, sin};

#[test]
fn the_root_load_has_the_moment_of_the_flank_load_about_the_apex() {
    // e_R × t over the root, from the first harmonics, with the tooth's middle at ζ = 0 in the plane x, z
    let pair = Pair::new(&GearSpec::default());
    for i in 0..2 {
        let section = SectionSpec::of_gear(&pair, i).with_fillet(0.4 * pair.module, "").expect("a gap");
        let patch = RootPatch::new(&pair, i, &section);
        let (s, c) = (sin(patch.polar), cos(patch.polar));
        let [even, first] = [0, 1].map(|n| patch.waves(n));
        for angle in [-0.3, 0.0, 0.2, 0.4] {
            let load = patch.load(angle);
            let of = |n: usize, k: usize| -> f64 {
                let waves = if n == 0 { &even } else { &first };
                TAU * s * s * (0..3).map(|j| if j == 1 { 0.0 } else { load[j] * waves[j][k] }).sum::<f64>()
            };
            // about z: W sin φ. About x: −V sin ζ − W cos φ cos ζ. V = 2 V₁ sin ζ and W = 2 W₁ cos ζ of the first wave
            let about_z = s * of(0, 2) / s;
            let about_x = (-of(1, 1) - c * of(1, 2)) / s;
            let crossing = asin(sin(pair.gears[i].base) / cos(angle));
            assert!((about_z - sin(pair.gears[i].base)).abs() < 1e-9, "{i} {angle}: {about_z}");
            assert!((about_x + cos(angle) * cos(crossing)).abs() < 1e-9, "{i} {angle}: {about_x}");
            // about y, from the force along: V cos ζ − W cos φ sin ζ, with w = −W₁
            let along = &first[1];
            let about_y = TAU * s * load[1] * (along[1] + c * along[2]);
            assert!((about_y - sin(angle)).abs() < 1e-9, "{i} {angle}: {about_y}");
        }
    }
}

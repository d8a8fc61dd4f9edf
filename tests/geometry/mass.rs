//! Tests of volumes, masses and moments of inertia, compared with integrals over the outline that use no facets.
//!
//! At every azimuth, the half-plane from the axis cuts the body between the apex and its end at the cone distance R in
//! the polygon apex – outline – root circle – axis. The same polygon at the toe, and the bore, are subtracted. Over a
//! triangle from the apex to P = (ρ, z) and Q, a moment of degree n is |P × Q|/(n + 2) times its mean along PQ. The
//! outline itself is integrated by the midpoint rule along flanks and fillets.

use std::f64::consts::{PI, TAU};

use crate::solid::{fillet, specs, volume};
use bevel_differential::geometry::involute::Gear;
use bevel_differential::geometry::solid::mass::{GearMass, gear_mass};
use bevel_differential::geometry::solid::{Foot, GearSolid};
use bevel_differential::geometry::{GearSpec, Pair};

const DENSITY: f64 = 7800.0;
/// Relative error at 64 facets below which positive and negative error terms cancel.
const LEVEL: f64 = 3e-7;

/// Integrands per unit of azimuth: volume, and moments of z, of the squared distance from the axis, and of z².
type Moments = [f64; 4];

/// Moments of the triangle from the apex to `p` and `q`, each (ρ, z): ∫∫ ρ (1, z, ρ², z²) dρ dz.
fn triangle(p: [f64; 2], q: [f64; 2]) -> Moments {
    let double = (p[0] * q[1] - p[1] * q[0]).abs();
    // Simpson's rule is exact for cubics
    let mean = |f: &dyn Fn(f64, f64) -> f64| {
        (f(p[0], p[1]) + 4.0 * f((p[0] + q[0]) / 2.0, (p[1] + q[1]) / 2.0) + f(q[0], q[1])) / 6.0
    };
    [
        double / 3.0 * mean(&|r, _| r),
        double / 4.0 * mean(&|r, z| r * z),
        double / 5.0 * mean(&|r, _| r.powi(3)),
        double / 5.0 * mean(&|r, z| r * z * z),
    ]
}

/// Mass properties of `gear` with fillets of the angular radius `wanted` between the cone distances `cones`.
fn exact(gear: &Gear, wanted: f64, [inner, outer]: [f64; 2], bore: f64) -> GearMass {
    let (height, root) = (gear.root.cos(), gear.root.sin());
    let (frustum, hub) = (triangle([root, height], [0.0, height]), bore / 2.0);
    let teeth = ring(gear, wanted, &|polar| triangle([polar.sin(), polar.cos()], [root, height]));
    let unit = [0, 1, 2, 3].map(|k| teeth[k] + TAU * frustum[k]);
    let grown = |n: i32| outer.powi(n) - inner.powi(n);
    let bored = [1, 2, 3].map(|n| PI * hub * hub * height.powi(n) * grown(n) / f64::from(n));
    let volume = unit[0] * grown(3) - bored[0];
    let axial = unit[2] * grown(5) - 0.5 * hub * hub * bored[0];
    let along = unit[3] * grown(5) - bored[2];
    GearMass {
        mass: DENSITY * volume,
        centre: (unit[1] * grown(4) - bored[1]) / volume,
        axial: DENSITY * axial,
        transverse_at_apex: DENSITY * (0.5 * axial + along),
    }
}

/// ∮ f(φ) dθ over the whole outline of `gear`.
fn ring(gear: &Gear, wanted: f64, f: &dyn Fn(f64) -> Moments) -> Moments {
    let steps = 20_000;
    let half = 0.5 / f64::from(steps);
    let middles = || (0..steps).map(|k| (f64::from(k) + 0.5) / f64::from(steps));
    let foot = Foot::new(gear, wanted);
    let (start, tip) = (foot.start_arc, gear.action_arc(gear.tip));
    let mut sum = Moments::default();
    let mut add = |polar: f64, width: f64| {
        for (sum, value) in sum.iter_mut().zip(f(polar)) {
            *sum += 2.0 * f64::from(gear.teeth) * value * width;
        }
    };
    let psi = |u: f64| start + (tip - start) * u;
    for u in middles() {
        add(gear.polar_at(psi(u)), gear.inv_of_arc(psi(u + half)) - gear.inv_of_arc(psi(u - half)));
        if foot.radius > 0.0 {
            add(foot.fillet_at(u)[0], foot.fillet_at(u - half)[1] - foot.fillet_at(u + half)[1]);
        }
    }
    add(gear.tip, gear.half_angle(gear.tip));
    add(foot.floor, foot.middle - foot.centre);
    sum
}

/// All planets and side gears of the test specifications, with the exact solution and a name.
fn gears() -> Vec<(String, GearSpec, Pair, usize, GearMass)> {
    let mut all = Vec::new();
    for (name, spec) in specs() {
        let pair = Pair::new(&spec);
        for (i, bore) in [spec.planet_bore, spec.side_bore].into_iter().enumerate() {
            let exact = exact(&pair.gears[i], fillet(&spec, &pair), [pair.inner_cone, pair.outer_cone], bore);
            all.push((format!("{name} {i}"), spec, pair, i, exact));
        }
    }
    all
}

/// Relative differences of all properties.
fn errors(a: &GearMass, b: &GearMass) -> [f64; 4] {
    let values = |m: &GearMass| [m.mass, m.centre, m.axial, m.transverse_at_apex];
    let (a, b) = (values(a), values(b));
    [0, 1, 2, 3].map(|k| a[k] / b[k] - 1.0)
}

#[test]
fn masses_converge_with_second_order_to_the_integral_over_the_outline() {
    let (mut seen, mut all) = (0, 0);
    for (name, spec, pair, i, exact) in gears() {
        let at = |facets| errors(&GearSolid::new(&pair, &spec, i, facets, 1).mass(DENSITY), &exact);
        let (coarse, fine) = (at(32), at(64));
        for k in 0..4 {
            all += 1;
            // chords of flanks are inside the body, chords of fillets outside; if both cancel, there is no order of
            // convergence
            if fine[k].abs() < LEVEL {
                continue;
            }
            seen += 1;
            let order = (coarse[k] / fine[k]).log2();
            assert!((1.8..2.2).contains(&order), "{name} {k}: order {order} {coarse:?} {fine:?}");
        }
        assert!(at(256).iter().all(|e| e.abs() < 5e-6), "{name}: {:?}", at(256));
    }
    assert!(seen > 3 * all / 4, "{seen} of {all}");
}

#[test]
fn inertias_of_the_simulation_are_within_the_stated_error() {
    for (name, spec, pair, i, exact) in gears() {
        let found = errors(&gear_mass(&pair, &spec, i, DENSITY), &exact);
        assert!(found.iter().all(|e| e.abs() < 2e-5), "{name}: {found:?}");
    }
}

#[test]
fn the_exported_gear_has_the_mass_of_the_simulation() {
    for (name, spec, pair, i, _) in gears() {
        let whole = GearSolid::new(&pair, &spec, i, 96, 1);
        let found = errors(&gear_mass(&pair, &spec, i, DENSITY), &whole.mass(DENSITY));
        assert!(found.iter().all(|e| e.abs() < 1e-9), "{name}: {found:?}");
        let weighed = whole.mass(DENSITY).mass / (DENSITY * volume(&whole));
        assert!((weighed - 1.0).abs() < 1e-9, "{name}: {weighed}");
    }
}

#[test]
fn a_root_circle_all_around_results_in_a_cone() {
    // textbook values of a cone of height h and base radius r about its apex
    let (height, root) = (0.8f64, 0.6f64);
    let [volume, first, square, along] = triangle([root, height], [0.0, height]).map(|m| TAU * m);
    let cone = PI / 3.0 * root * root * height;
    for (found, textbook) in [
        (volume, cone),
        (first, cone * 0.75 * height),
        (square, cone * 0.3 * root * root),
        (along, cone * 0.6 * height * height),
    ] {
        assert!((found / textbook - 1.0).abs() < 1e-14, "{found} {textbook}");
    }
}

#[test]
fn small_gears_are_large_ones_scaled_down() {
    let scale = 0.05f64;
    for (name, spec, pair, i, _) in gears() {
        let [face_width, backlash] = [spec.face_width, spec.backlash].map(|v| v * scale);
        let [planet_bore, side_bore] = [spec.planet_bore, spec.side_bore].map(|v| v * scale);
        let small = GearSpec { module: spec.module * scale, face_width, backlash, planet_bore, side_bore, ..spec };
        // the dedendum of some systems has a constant part
        let small_pair = Pair { gears: pair.gears, ..Pair::new(&small) };
        let found = gear_mass(&small_pair, &small, i, DENSITY);
        let grown = GearMass {
            mass: found.mass / scale.powi(3),
            centre: found.centre / scale,
            axial: found.axial / scale.powi(5),
            transverse_at_apex: found.transverse_at_apex / scale.powi(5),
        };
        let apart = errors(&grown, &gear_mass(&pair, &spec, i, DENSITY));
        assert!(apart.iter().all(|e| e.abs() < 1e-9), "{name} {i}: {apart:?}");
    }
}

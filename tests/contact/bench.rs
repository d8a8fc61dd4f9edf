//! The contact law against Adams' IMPACT table and Hertz' closed forms (tests/data/golden_contact_bench.json).

use bevel_differential::contact::damping::{Damping, restitution};
use bevel_differential::contact::hertz;
use bevel_differential::contact::impact::Impact;
use serde_json::Value;

fn golden() -> Value {
    serde_json::from_str(include_str!("../data/golden_contact_bench.json")).expect("valid JSON")
}

fn f(v: &Value, key: &str) -> f64 {
    v[key].as_f64().unwrap_or_else(|| panic!("no number {key} in {v}"))
}

fn elastic(stiffness: f64, exponent: f64) -> Impact {
    Impact { stiffness, exponent, damping: 0.0, per_full_depth: 1e4 }
}

#[test]
fn impact_equals_adams_table() {
    let golden = golden();
    let rows = golden["Adams_IMPACT_table"].as_array().expect("a table");
    assert_eq!(rows.len(), 7);
    let mut worst = 0.0f64;
    for row in rows {
        let law = Impact {
            stiffness: f(row, "k"),
            exponent: f(row, "e"),
            damping: f(row, "cmax"),
            per_full_depth: 1.0 / f(row, "d"),
        };
        // Adams measures the distance x of the bodies, free length x1: penetration x1 − x, its rate −ẋ
        let force = law.force(f(row, "x1") - f(row, "x"), -f(row, "xd")).total;
        worst = worst.max((force - f(row, "F")).abs());
        assert!((force - f(row, "F")).abs() <= 1e-12 * f(row, "F").max(1.0), "{row}: {force}");
    }
    println!("worst {worst:e} N");
}

#[test]
fn stiffness_from_hertz_matches_the_golden_value_of_the_study_s_pair() {
    let k = hertz::stiffness(22.5e-3, 36e-3, 2.07e11, 0.25);
    let expected = f(&golden()["hertz_impact_m1kg_v1_K1.732e10"], "K");
    println!("relative deviation {:e}", k / expected - 1.0);
    assert!((k / expected - 1.0).abs() < 1e-12, "{k} {expected}");
}

#[test]
fn a_free_body_stops_at_the_hertzian_depth_and_force() {
    let golden = golden();
    let mut worst = 0.0f64;
    for key in ["hertz_impact_m1kg_v1_K1.732e10", "hertz_impact_m0.5_v0.1_K1e9"] {
        let case = &golden[key];
        let law = elastic(f(case, "K"), f(case, "n"));
        let (depth, kinetic) = (f(case, "delta_max"), 0.5 * f(case, "m") * f(case, "v").powi(2));
        for off in [law.energy(depth) / kinetic - 1.0, law.force(depth, 0.0).total / f(case, "F_max") - 1.0] {
            worst = worst.max(off.abs());
            assert!(off.abs() < 1e-12, "{key}: {off:e}");
        }
    }
    println!("worst {worst:e}");
    // linear contact, printed with v = 1 m/s, m = 1 kg, k = 3.58e8 N/m
    let case = &golden["linear_impact_m1_v1_k3.58e8"];
    let law = elastic(3.58e8, 1.0);
    assert!((law.energy(f(case, "delta_max")) / 0.5 - 1.0).abs() < 1e-12);
    assert!((law.force(f(case, "delta_max"), 0.0).total / f(case, "F_max") - 1.0).abs() < 1e-12);
}

#[test]
fn a_body_in_a_dead_zone_swings_as_far_as_its_energy_allows() {
    for case in golden()["deadzone_free_period"].as_array().expect("a table") {
        let depth = f(case, "x_max") - f(case, "gap_total") / 2.0;
        let energy = elastic(f(case, "k"), 1.0).energy(depth);
        assert!((energy / (0.5 * f(case, "m") * f(case, "v0").powi(2)) - 1.0).abs() < 1e-11, "{case}");
    }
}

/// Ratio of rebound to impact speed, and largest penetration, of a mass hitting a law: fourth-order Runge–Kutta method.
fn rebound(force: impl Fn(f64, f64) -> f64, mass: f64, speed: f64, step: f64) -> (f64, f64) {
    let slope = |[d, v]: [f64; 2]| [v, if d > 0.0 { -force(d, v) / mass } else { 0.0 }];
    let along = |[d, v]: [f64; 2], k: [f64; 2], h: f64| [d + h * k[0], v + h * k[1]];
    let (mut y, mut deepest) = ([0.0, speed], 0.0f64);
    loop {
        let k1 = slope(y);
        let k2 = slope(along(y, k1, step / 2.0));
        let k3 = slope(along(y, k2, step / 2.0));
        let k4 = slope(along(y, k3, step));
        for i in 0..2 {
            y[i] += step / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
        deepest = deepest.max(y[0]);
        if y[0] <= 0.0 {
            return (-y[1] / speed, deepest);
        }
    }
}

#[test]
fn a_mass_rebounds_from_impact_with_the_golden_restitution() {
    let golden = golden();
    let table = golden["Adams_IMPACT_restitution(m=1kg=1e-3t,k=5.477e5N/mm^1.5,e=1.5,c=50Ns/mm? d=0.1mm)"]
        .as_object()
        .expect("a table");
    let (mut worst_e, mut worst_d) = (0.0f64, 0.0f64);
    for (key, row) in table {
        let number = |part: &str| -> f64 {
            let from = key.find(part).expect("named in the key") + part.len();
            key[from..].trim_end_matches("mm/s").split(['m', ' ']).next().unwrap_or("").parse().expect("a number")
        };
        let law = Impact {
            stiffness: 5.477e5 * 1e3f64.powf(1.5),
            exponent: 1.5,
            damping: number("c=") * 1e3,
            per_full_depth: 1e4,
        };
        let (e, depth) = rebound(|d, v| law.force(d, v).total, 1.0, number("v0=") * 1e-3, 1e-8);
        worst_e = worst_e.max((e - row[0].as_f64().expect("e")).abs());
        worst_d = worst_d.max((depth * 1e3 / row[1].as_f64().expect("mm") - 1.0).abs());
    }
    println!("restitution off by {worst_e:e}, depth by {worst_d:e} (relative)");
    // the depth is the largest value at a step of each integration, not between steps
    assert!(worst_e < 1e-8 && worst_d < 2e-5);
}

#[test]
fn a_mass_rebounds_from_damping_by_restitution_with_the_speed_of_the_exact_relation() {
    let (mass, speed) = (0.7, 0.8);
    for exponent in [1.0, 1.5] {
        for dimensionless in [0.0, 0.1, 0.5, 1.0, 2.0] {
            let stiffness = 1.7e10f64.powf(exponent / 1.5);
            let damping = Damping::HuntCrossley { lambda: dimensionless / speed };
            let force = |d: f64, rate: f64| {
                let slope = stiffness * exponent * d.powf(exponent - 1.0);
                damping.apply(slope * d / exponent, slope, d, rate).total
            };
            let error = (rebound(force, mass, speed, 1e-8).0 - restitution(dimensionless)).abs();
            assert!(error < 1e-6, "n = {exponent}, D = {dimensionless}: off by {error:e}");
        }
    }
}

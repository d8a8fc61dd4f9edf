//! The laws derived from tooth stiffness: exact derivatives, no jumps, exact inversion, and valid results for all
//! gears.

use crate::stiffness_pairs::{
    LINE_LOAD, PER_MM_UM, STEEL, buildable, default, golden, golden_spec, random_pairs, stiffness,
};
use bevel_differential::contact::spring::{AnySpring, Elastic, Spring};
use bevel_differential::contact::stiffness::{PairStiffness, RootSpec};
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair};

/// Positions along and beyond the path.
fn places(stiffness: &PairStiffness) -> impl Iterator<Item = f64> {
    let [low, high] = stiffness.range;
    (-8..=48).map(move |j| low + (high - low) * (f64::from(j) + 0.37) / 40.0)
}

/// Compliance Q [1/Pa] at position `s` under the limit load ω₀, from the compliance at the reference load.
fn limit_compliance(stiffness: &PairStiffness, s: f64) -> f64 {
    assert!(stiffness.limit >= stiffness.reference);
    stiffness.line().compliance(s) - STEEL.hertz_factor() * (stiffness.limit / stiffness.reference).ln()
}

fn assert_derivatives(law: &impl Spring, p: f64, s: f64, span: f64) {
    let e = law.at(p, s);
    let difference = |f: fn(&Elastic) -> f64, dp: f64, ds: f64| {
        (f(&law.at(p + dp, s + ds)) - f(&law.at(p - dp, s - ds))) / (2.0 * (dp + ds))
    };
    let close = |name: &str, found: f64, expected: f64, scale: f64| {
        assert!((found - expected).abs() < 2e-6 * scale, "{name} at p {p:e}, s {s}: {found:e} {expected:e}");
    };
    let (hp, hs) = (1e-5 * p, 1e-7 * span);
    close("torque", e.torque, difference(|e| e.energy, hp, 0.0), e.torque);
    close("stiffness", e.stiffness, difference(|e| e.torque, hp, 0.0), e.stiffness);
    close("mixed", e.torque_by_s, difference(|e| e.by_s, hp, 0.0), e.torque / span);
    close("by s", e.by_s, difference(|e| e.energy, 0.0, hs), e.energy / span);
    close("mixed", e.torque_by_s, difference(|e| e.torque, 0.0, hs), e.torque / span);
    let curvature = e.energy / (span * span) + e.by_s_twice.abs();
    close("twice", e.by_s_twice, difference(|e| e.by_s, 0.0, hs), 100.0 * curvature);
}

#[test]
fn both_laws_have_the_exact_derivatives_of_their_energy() {
    let stiffness = golden();
    let (line, weber) = (stiffness.line(), stiffness.line_weber());
    let span = stiffness.range[1] - stiffness.range[0];
    for s in places(&stiffness) {
        for p in [1e-8, 1e-5, 1e-3, 0.02, 0.3] {
            assert_derivatives(&line, p, s, span);
            assert_derivatives(&weber, p, s, span);
        }
    }
}

#[test]
fn force_and_slopes_have_no_jumps_at_the_path_s_ends_nor_at_the_load_limit() {
    let stiffness = golden();
    let (line, weber) = (AnySpring::Line(stiffness.line()), AnySpring::LineWeber(stiffness.line_weber()));
    let same = |law: &AnySpring, a: (f64, f64), b: (f64, f64)| {
        let (x, y) = (law.at(a.0, a.1), law.at(b.0, b.1));
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * a.abs().max(b.abs());
        assert!(near(x.energy, y.energy) && near(x.torque, y.torque) && near(x.stiffness, y.stiffness));
        assert!(near(x.by_s, y.by_s) && near(x.torque_by_s, y.torque_by_s));
        assert!(near(x.by_s_twice, y.by_s_twice));
    };
    for end in stiffness.range {
        for p in [1e-6, 1e-3] {
            same(&line, (p, end - 1e-11), (p, end + 1e-11));
            same(&weber, (p, end - 1e-11), (p, end + 1e-11));
        }
    }
    // at the limit load the arc is ω₀ Q
    for s in places(&stiffness) {
        let p = stiffness.limit * limit_compliance(&stiffness, s);
        let (below, above) = (weber.at(p * (1.0 - 1e-12), s), weber.at(p * (1.0 + 1e-12), s));
        assert!((below.torque / above.torque - 1.0).abs() < 1e-10);
        assert!((below.stiffness / above.stiffness - 1.0).abs() < 1e-10);
        assert!((below.energy / above.energy - 1.0).abs() < 1e-10);
    }
}

#[test]
fn the_load_solves_the_compliance_equation_exactly() {
    let stiffness = golden();
    let weber = stiffness.line_weber();
    let local = STEEL.hertz_factor();
    let mut worst = 0f64;
    for s in places(&stiffness) {
        let q = limit_compliance(&stiffness, s);
        let mut last = 0.0;
        for j in 0..=500 {
            let p = 1e-12 * 10f64.powf(f64::from(j) / 50.0);
            let load = weber.at(p, s).torque;
            worst = worst.max((load * (q - local * (load / stiffness.limit).ln()) / p - 1.0).abs());
            assert!(load > last, "more penetration, more load");
            last = load;
        }
    }
    println!("worst residual {worst:e}");
    assert!(worst < 1e-14);
}

#[test]
fn both_laws_have_the_same_stiffness_at_the_reference_load() {
    for stiffness in [golden(), default()] {
        let (line, weber) = (stiffness.line(), stiffness.line_weber());
        for s in places(&stiffness) {
            let p = stiffness.reference * line.compliance(s);
            let (linear, logarithmic) = (line.at(p, s), weber.at(p, s));
            assert!((linear.torque / stiffness.reference - 1.0).abs() < 1e-13);
            assert!((logarithmic.torque / stiffness.reference - 1.0).abs() < 1e-13);
            // the tangent is stiffer, because Hertz's compliance decreases with load: 1/(q − B) compared with 1/q
            let tangent = 1.0 / (line.compliance(s) - STEEL.hertz_factor());
            assert!((logarithmic.stiffness / tangent - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn the_linear_law_above_the_load_limit_follows_the_tangent() {
    let pair = Pair::new(&GearSpec::default());
    let stiffness = PairStiffness::new(&pair, &RootSpec::default(), STEEL.young, STEEL.poisson, 5e8).expect("a pair");
    assert!(stiffness.reference > stiffness.limit);
    let p = stiffness.reference * stiffness.line().compliance(0.1);
    assert!((stiffness.line_weber().at(p, 0.1).torque / stiffness.reference - 1.0).abs() < 1e-12);
}

#[test]
fn the_work_of_the_torque_equals_the_energy() {
    let stiffness = default();
    let (line, weber) = (stiffness.line(), stiffness.line_weber());
    for law in [AnySpring::Line(line), AnySpring::LineWeber(weber)] {
        // Simpson's rule in u = √p removes the singularity of the logarithm at p = 0
        let (end, n) = (0.2f64, 20_000);
        let h = end.sqrt() / f64::from(n);
        let work: f64 = (1..=n)
            .map(|j| {
                let u = h * f64::from(j);
                let weight = if j == n { 1.0 } else { 2.0 + 2.0 * f64::from(j % 2) };
                weight * 2.0 * u * law.at(u * u, 0.05).torque
            })
            .sum();
        let energy = law.at(end, 0.05).energy;
        assert!((work * h / 3.0 / energy - 1.0).abs() < 1e-9, "{}", work * h / 3.0 / energy);
    }
}

#[test]
fn the_table_equals_the_formulas_within_a_millionth_on_the_path_and_past_its_ends() {
    let mut worst = (0f64, String::new());
    let mut compare = |name: String, spec: &GearSpec, stiffness: &PairStiffness| {
        let base_pitch = Pair::new(spec).base_pitch;
        let ([low, high], corner) = (stiffness.range, stiffness.corner_range);
        // past the ends, only from the distance at which the blend from the path to the corner is complete
        let blended = 4e-3 * base_pitch;
        let parts = [[low, high], [low - corner[0], low - blended], [high + blended, high + corner[1]]];
        for j in 0..=6000 {
            let part = parts[j % 3];
            if part[0] >= part[1] {
                continue;
            }
            // points cluster at the ends of each range, near which the compliance contains logarithms
            let share = 0.5 - 0.5 * (j as f64 * std::f64::consts::PI / 6000.0).cos();
            let s = part[0] + (part[1] - part[0]) * share;
            let exact = stiffness.exact(s, stiffness.reference).stiffness();
            let difference = (stiffness.at(s) / exact - 1.0).abs();
            if stiffness.reference < stiffness.limit && difference > worst.0 {
                worst = (difference, format!("{name} at {share}"));
            }
        }
    };
    compare("golden".into(), &golden_spec(), &golden());
    // undercut planet: the path is clipped where Hertz's logarithm diverges
    let clipped = GearSpec { addendum_system: AddendumSystem::Standard, ..GearSpec::default() };
    assert_eq!(Pair::new(&clipped).path.clipped, [true, false]);
    compare("clipped".into(), &clipped, &stiffness(&clipped, 0.25));
    for spec in random_pairs(7).filter(buildable).take(150) {
        if let Ok(k) = PairStiffness::new(&Pair::new(&spec), &RootSpec::default(), STEEL.young, 0.25, LINE_LOAD) {
            compare(format!("{spec:?}"), &spec, &k);
        }
    }
    println!("worst {worst:?}");
    assert!(worst.0 < 1e-6, "{worst:?}");
}

#[test]
fn every_buildable_pair_has_a_stiffness_or_an_error_with_its_cause() {
    let (mut sound, mut refused, mut cut) = (0, std::collections::BTreeMap::new(), 0);
    for spec in random_pairs(1).filter(buildable).take(1500) {
        let pair = Pair::new(&spec);
        let stiffness = match PairStiffness::new(&pair, &RootSpec::default(), STEEL.young, STEEL.poisson, LINE_LOAD) {
            Ok(stiffness) => stiffness,
            Err(problem) => {
                assert!(problem.variable.starts_with("geometry.") && !problem.message.is_empty());
                *refused
                    .entry((problem.variable, problem.message.split(" mm").last().unwrap().to_owned()))
                    .or_insert(0) += 1;
                continue;
            }
        };
        sound += 1;
        let length = stiffness.range[1] - stiffness.range[0];
        cut += i32::from(length < 0.99 * (pair.path.high - pair.path.low) - 0.01 * pair.base_pitch);
        let (line, weber) = (stiffness.line(), stiffness.line_weber());
        for j in -30..=130 {
            let s = pair.path.low + (pair.path.high - pair.path.low) * f64::from(j) / 100.0;
            let c = stiffness.at(s) / PER_MM_UM;
            assert!(c > 0.05 && c < 200.0, "c = {c} at {s} for {spec:?}");
            for p in [1e-12, 1e-6, 1e-3, 0.1, 3.0] {
                for e in [line.at(p, s), weber.at(p, s)] {
                    assert!(e.energy > 0.0 && e.torque > 0.0 && e.stiffness > 0.0 && e.energy.is_finite());
                    assert!((e.by_s + e.torque_by_s + e.by_s_twice).is_finite(), "{e:?} {spec:?}");
                }
            }
        }
        let mean = stiffness.mesh_mean() / PER_MM_UM;
        assert!(mean > 0.0 && mean < 400.0, "{mean}");
    }
    println!("{sound} sound, of which {cut} with a shortened range; refused {refused:?}");
    assert!(sound > 1000);
}

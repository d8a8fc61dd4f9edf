//! Damping of a pair: derivatives, restitution, and the laws of the literature.

use bevel_differential::contact::damping::*;
use bevel_differential::contact::impact::Impact;

fn golden() -> serde_json::Value {
    serde_json::from_str(include_str!("../data/golden_contact_bench.json")).unwrap()
}

#[test]
fn impact_and_step_damping_match_the_formula_of_adams() {
    for exponent in [1.0, 1.3, 1.5, 2.0, 2.5] {
        let law = Impact { stiffness: 3e9, exponent, damping: 4e4, per_full_depth: 1e4 };
        let damping = Damping::Step { coefficient: law.damping, per_full_depth: law.per_full_depth };
        for d in [1e-9, 1e-6, 3.3e-5, 9e-5, 1e-4, 2e-4] {
            for rate in [-3.0, -1e-3, 0.0, 0.05, 2.0] {
                let f = law.force(d, rate);
                // at rest, the derivative with respect to depth is the elastic one
                let stiffness = law.force(d, 0.0).by_depth;
                assert_eq!(damping.apply(f.elastic, stiffness, d, rate), f);
                let u = (d * 1e4).min(1.0);
                let formula = 3e9 * d.powf(exponent) + 4e4 * (3.0 * u.powi(2) - 2.0 * u.powi(3)) * rate;
                let size = 3e9 * d.powf(exponent) + 4e4 * rate.abs();
                assert!((f.total - formula.max(0.0)).abs() < 1e-14 * size, "{exponent} {d} {rate}: {f:?}");
            }
        }
    }
}

#[test]
fn derivatives_are_exact_and_flanks_never_pull() {
    let (k, n) = (2e10, 1.5);
    let laws = [Damping::Step { coefficient: 4e4, per_full_depth: 1e4 }, Damping::HuntCrossley { lambda: 1.7 }];
    for law in laws {
        let force = |d: f64, rate: f64| law.apply(k * d.powf(n), k * n * d.powf(n - 1.0), d, rate);
        for d in [1e-6, 4e-5, 2e-4] {
            for rate in [-5.0, -0.6, -0.1, 0.0, 0.3, 2.0] {
                let f = force(d, rate);
                assert!(f.total >= 0.0);
                if f.total > 0.0 {
                    let h = 1e-5;
                    let by_depth =
                        (force(d * (1.0 + h), rate).total - force(d * (1.0 - h), rate).total) / (2.0 * h * d);
                    assert!((f.by_depth / by_depth - 1.0).abs() < 1e-7);
                    let by_rate = (force(d, rate + h).total - force(d, rate - h).total) / (2.0 * h);
                    assert!((f.by_rate / by_rate - 1.0).abs() < 1e-7);
                } else {
                    assert_eq!((f.by_depth, f.by_rate, f.elastic), (0.0, 0.0, k * d.powf(n)));
                }
            }
        }
    }
}

#[test]
fn restitution_follows_the_exact_relation() {
    let golden = golden();
    for (damping, e) in golden["HC_exact_e_vs_D"].as_object().unwrap() {
        let (damping, e): (f64, f64) = (damping.parse().unwrap(), e.as_f64().unwrap());
        assert!((restitution(damping) - e).abs() < 1e-13, "D = {damping}: {} for {e}", restitution(damping));
        assert!((dimensionless_damping(e).unwrap() / damping - 1.0).abs() < 1e-12);
    }
    for (e, damping) in golden["HC_exact_D_for_e"].as_object().unwrap() {
        let (e, damping): (f64, f64) = (e.parse().unwrap(), damping.as_f64().unwrap());
        assert!((dimensionless_damping(e).unwrap() / damping - 1.0).abs() < 1e-12, "e = {e}");
    }
    for (damping, e) in [(0.1, 0.937476), (0.5, 0.748435), (1.0, 0.593624), (2.0, 0.410720)] {
        assert!((restitution(damping) - e).abs() < 1e-6);
    }
}

#[test]
fn approximate_laws_of_the_literature_have_the_restitution_they_are_known_for() {
    for (nominal, actual) in golden()["HC_models_actual_e_for_nominal"].as_object().unwrap() {
        let e: f64 = nominal.parse().unwrap();
        for (name, damping) in [
            ("HuntCrossley_1.5(1-e)", 1.5 * (1.0 - e)),
            ("LankaraniNikravesh_0.75(1-e^2)", 0.75 * (1.0 - e * e)),
            ("Flores_8(1-e)/(5e)", 1.6 * (1.0 - e) / e),
        ] {
            let actual = actual[name].as_f64().unwrap();
            assert!((restitution(damping) - actual).abs() < 1e-12, "{name} at {nominal}");
        }
    }
}

#[test]
fn relation_and_inverse_agree_from_no_damping_to_the_least_restitution() {
    for i in 50..1000 {
        let e = f64::from(i) / 1e3;
        let back = restitution(dimensionless_damping(e).unwrap());
        assert!((back - e).abs() < 2e-14, "e = {e}: {back}");
    }
    for tiny in [1e-3, 1e-6, 1e-9, 1e-12] {
        let damping = dimensionless_damping(1.0 - tiny).unwrap();
        assert!((damping - 1.5 * tiny * (1.0 + tiny)).abs() < 2.0 * tiny * tiny * tiny + 1e-15, "{tiny}: {damping}");
    }
    assert_eq!((dimensionless_damping(1.0), restitution(0.0)), (Ok(0.0), 1.0));
    assert!((restitution(1e6) * 1e6 - 1.0).abs() < 1e-12 && restitution(f64::INFINITY) == 0.0);
}

#[test]
fn restitutions_out_of_range_are_rejected_by_name() {
    for e in [-0.1, 0.0, 0.049, 1.001, f64::NAN, f64::INFINITY] {
        let problem = dimensionless_damping(e).unwrap_err();
        assert_eq!(problem.variable, "contact.restitution");
        assert!(problem.message.contains("0.05 to 1"));
    }
}

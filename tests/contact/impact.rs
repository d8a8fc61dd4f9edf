//! The law IMPACT: force, derivatives, energy.

use bevel_differential::contact::impact::*;

#[test]
fn force_is_the_derivative_of_the_energy_and_derivatives_are_exact() {
    for exponent in [1.0, 1.3, 1.5, 2.0, 2.2] {
        let law = Impact { stiffness: 3e9, exponent, damping: 4e4, per_full_depth: 1e4 };
        for d in [1e-6, 3e-5, 9e-5, 2e-4] {
            for rate in [-1e-3, 0.0, 0.05] {
                let h = d * 1e-5;
                let f = law.force(d, rate);
                let work = (law.energy(d + h) - law.energy(d - h)) / (2.0 * h);
                assert!((f.elastic / work - 1.0).abs() < 1e-8);
                if f.total > 0.0 {
                    let by_depth = (law.force(d + h, rate).total - law.force(d - h, rate).total) / (2.0 * h);
                    assert!((f.by_depth - by_depth).abs() < 1e-6 * by_depth.abs());
                    let by_rate = (law.force(d, rate + 1e-6).total - f.total) / 1e-6;
                    assert!((f.by_rate - by_rate).abs() < 1e-6 * (1.0 + by_rate));
                }
            }
        }
    }
}

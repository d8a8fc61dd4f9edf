//! Stress cycles about a mean stress.

use bevel_differential::strength::mean_stress::*;
use bevel_differential::strength::rainflow::LoadCycle;

fn cycle(low: f64, high: f64) -> LoadCycle {
    LoadCycle { range: high - low, mean: (high + low) / 2.0, count: 1.0 }
}

#[test]
fn a_pulsating_cycle_is_unchanged_and_an_alternating_one_follows_the_idler_factor() {
    assert!((pulsating_range(&cycle(0.0, 5.0), 0.4) - 5.0).abs() < 1e-14);
    // Y_M = 0.7: an alternating peak does the same damage as a pulsating peak of 1/0.7 times its size
    assert!((pulsating_range(&cycle(-5.0, 5.0), 0.4) - 5.0 / 0.7).abs() < 1e-14);
}

#[test]
fn the_line_is_continuous_and_a_ripple_about_a_high_mean_does_little_damage() {
    for r in [-1.0, 1.0, 3.0] {
        let at = |r: f64| pulsating_range(&LoadCycle { range: 2.0, mean: r, count: 1.0 }, 0.4);
        assert!((at(r + 1e-9) - at(r - 1e-9)).abs() < 1e-8);
    }
    assert!(pulsating_range(&cycle(834.0, 836.0), 0.4) < 3.0);
    assert_eq!(pulsating_range(&cycle(5.0, 5.0), 0.4), 0.0);
    assert_eq!(pulsating_range(&cycle(f64::NAN, 5.0), 0.4), 0.0);
}

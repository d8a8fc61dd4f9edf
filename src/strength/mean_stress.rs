//! The pulsating cycle (from 0 to its range) that does the same damage as a cycle about any mean stress.
//!
//! FKM guideline, *Analytical strength assessment*: with the sensitivity M and r = σ_m/σ_a, the permissible
//! amplitude at this mean is K σ_W, where
//!
//! ```text
//! r ≤ 1         K = 1/(1 + M r)                          (stress ratio up to 0; below −1, 1/(1 − M))
//! 1 < r < 3     K = (1 + M/3)/((1 + M)(1 + M r/3))       (0 to 0.5)
//! r ≥ 3         K = (1 + M/3)/(1 + M)²                   (above 0.5)
//! ```
//!
//! On r ≤ 1 it is the line of ISO 6336-3's idler factor: Y_M = 1/(1 − R(1 − M)/(1 + M)), (1 + M)/2 at R = −1.

use super::rainflow::LoadCycle;

/// Range [unit of the cycle] of the pulsating cycle equal in damage to `cycle` at the sensitivity `m`, 0 ≤ m < 1.
///
/// A positive mean is tension. For the root at the other flank pass the cycle with its mean negated.
pub fn pulsating_range(cycle: &LoadCycle, m: f64) -> f64 {
    let m = m.clamp(0.0, 0.99);
    let amplitude = cycle.range / 2.0;
    if amplitude.is_nan() || amplitude <= 0.0 {
        return 0.0;
    }
    let r = cycle.mean / amplitude;
    let permissible = if r <= 1.0 {
        1.0 / (1.0 + m * r.max(-1.0))
    } else if r < 3.0 {
        (1.0 + m / 3.0) / ((1.0 + m) * (1.0 + m * r / 3.0))
    } else {
        (1.0 + m / 3.0) / ((1.0 + m) * (1.0 + m))
    };
    // of a pulsating cycle K = 1/(1 + M)
    cycle.range / ((1.0 + m) * permissible)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cycle(low: f64, high: f64) -> LoadCycle {
        LoadCycle { range: high - low, mean: (high + low) / 2.0, count: 1.0 }
    }

    #[test]
    fn a_pulsating_cycle_is_unchanged_and_an_alternating_one_follows_the_idler_factor() {
        assert!((pulsating_range(&cycle(0.0, 5.0), 0.4) - 5.0).abs() < 1e-14);
        // Y_M = 0.7: an alternating peak is as bad as a pulsating one of 1/0.7
        assert!((pulsating_range(&cycle(-5.0, 5.0), 0.4) - 5.0 / 0.7).abs() < 1e-14);
    }

    #[test]
    fn the_line_is_continuous_and_a_ripple_about_a_high_mean_does_little() {
        for r in [-1.0, 1.0, 3.0] {
            let at = |r: f64| pulsating_range(&LoadCycle { range: 2.0, mean: r, count: 1.0 }, 0.4);
            assert!((at(r + 1e-9) - at(r - 1e-9)).abs() < 1e-8);
        }
        assert!(pulsating_range(&cycle(834.0, 836.0), 0.4) < 3.0);
        assert_eq!(pulsating_range(&cycle(5.0, 5.0), 0.4), 0.0);
        assert_eq!(pulsating_range(&cycle(f64::NAN, 5.0), 0.4), 0.0);
    }
}

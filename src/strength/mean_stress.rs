//! The pulsating cycle (from 0 to its range) with the same damage as a cycle about any mean stress.
//!
//! FKM guideline, *Analytical strength assessment*: with the sensitivity M and r = σ_m/σ_a, the permissible amplitude
//! at this mean stress is K σ_W, where
//!
//! ```text
//! r ≤ 1         K = 1/(1 + M r)                          (stress ratio up to 0; below −1, 1/(1 − M))
//! 1 < r < 3     K = (1 + M/3)/((1 + M)(1 + M r/3))       (0 to 0.5)
//! r ≥ 3         K = (1 + M/3)/(1 + M)²                   (above 0.5)
//! ```
//!
//! For r ≤ 1 this is the line of ISO 6336-3's idler factor: Y_M = 1/(1 − R(1 − M)/(1 + M)), (1 + M)/2 at R = −1.

use super::LoadCycle;

/// Range [unit of the cycle] of the pulsating cycle with the same damage as `cycle` at the sensitivity `m`, 0 ≤ m < 1.
///
/// A positive mean is tension. For the root at the other flank, pass the cycle with its mean negated.
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
    // for a pulsating cycle, K = 1/(1 + M)
    cycle.range / ((1.0 + m) * permissible)
}

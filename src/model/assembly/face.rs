//! The face of a tooth cut into slices, and where its load has its resultant.

use crate::contact::detailed::Slice;
use crate::geometry::Pair;

/// Cone distance at which a load per width that grows with R has its resultant [m].
pub fn centroid(pair: &Pair) -> f64 {
    let (outer, inner) = (pair.outer_cone, pair.inner_cone);
    2.0 / 3.0 * (outer * outer * outer - inner * inner * inner) / (outer * outer - inner * inner)
}

/// Gauss–Legendre points and weights on [−1, 1], eight of them (M. Abramowitz, I. A. Stegun, table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Slices of the face by Gauss's rule, weights times R².
pub fn gauss_slices(inner: f64, outer: f64) -> Vec<Slice> {
    let (middle, half) = (0.5 * (outer + inner), 0.5 * (outer - inner));
    let points = GAUSS.iter().rev().map(|&(x, w)| (-x, w)).chain(GAUSS);
    points
        .map(|(x, w)| {
            let cone = middle + half * x;
            Slice { cone, weight: half * w * cone * cone, width: half * w }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_integrate_over_the_face() {
        let (inner, outer) = (22.4e-3, 42.4e-3);
        let slices = gauss_slices(inner, outer);
        for power in 0..10 {
            let sum: f64 = slices.iter().map(|s| s.weight * s.cone.powi(power)).sum();
            let n = power + 3;
            let exact = (f64::powi(outer, n) - f64::powi(inner, n)) / f64::from(n);
            assert!((sum / exact - 1.0).abs() < 1e-13, "power {power}");
        }
        assert!(slices.windows(2).all(|s| s[0].cone < s[1].cone));
    }
}

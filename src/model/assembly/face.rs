//! Slices of the face of a tooth, and the position of the resultant load.

use crate::contact::detailed::{Face, Node, Slice};
use crate::geometry::Pair;

/// Cone distance [m] of the resultant of a line load proportional to R.
pub fn centroid(pair: &Pair) -> f64 {
    let (outer, inner) = (pair.outer_cone, pair.inner_cone);
    2.0 / 3.0 * (outer * outer * outer - inner * inner * inner) / (outer * outer - inner * inner)
}

/// Slices of the face by Gauss's rule, with weights multiplied by R².
pub fn gauss_slices(inner: f64, outer: f64) -> Vec<Slice> {
    let slice = |node: &Node| Slice { cone: node.cone, weight: node.weight, width: node.width };
    Face::gauss_points([inner, outer]).iter().map(slice).collect()
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

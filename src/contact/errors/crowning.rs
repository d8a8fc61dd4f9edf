//! Lengthwise crowning: the flank recedes toward both ends of the face.
//!
//!   e(R) = C_β ((R − R_m) / (b/2))²
//!
//! This is the parabola of ISO 21771 for symmetric crowning, here the sum for both flanks of a pair.

use super::ToothErrorSpec;
use crate::geometry::Pair;

/// Crowning of a tooth pair.
#[derive(Clone, Copy, Debug)]
pub struct Crowning {
    /// Gap at the ends of the face C_β [m].
    amount: f64,
    /// Mean cone distance R_m [m].
    middle: f64,
    /// Reciprocal of half the face width [1/m].
    per_half_width: f64,
}

impl Crowning {
    /// Returns the crowning defined by `spec` over the face of `pair`, or `None`.
    pub fn new(spec: &ToothErrorSpec, pair: &Pair) -> Option<Self> {
        (spec.crowning != 0.0).then(|| Self {
            amount: spec.crowning,
            middle: pair.mean_cone,
            per_half_width: 1.0 / (pair.outer_cone - pair.mean_cone),
        })
    }

    /// The gap as a polynomial in the cone distance R: coefficients of 1, R and R² [m, 1, 1/m].
    #[inline]
    pub fn polynomial(&self) -> [f64; 3] {
        let bend = self.amount * self.per_half_width * self.per_half_width;
        [bend * self.middle * self.middle, -2.0 * bend * self.middle, bend]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::GearSpec;

    #[test]
    fn crowning_is_a_parabola_over_the_face() {
        let pair = Pair::new(&GearSpec::default());
        let crowning = Crowning::new(&ToothErrorSpec { crowning: 8e-6, ..ToothErrorSpec::default() }, &pair).unwrap();
        let quarter = 0.5 * (pair.mean_cone + pair.outer_cone);
        for (r, e) in [(pair.inner_cone, 8e-6), (pair.mean_cone, 0.0), (quarter, 2e-6), (pair.outer_cone, 8e-6)] {
            let [even, turn, bend] = crowning.polynomial();
            assert!((even + r * (turn + r * bend) - e).abs() < 1e-18);
        }
        assert!(Crowning::new(&ToothErrorSpec::default(), &pair).is_none());
    }
}

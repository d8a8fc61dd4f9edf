//! Tip relief: material removed toward the tips, so that a bent pair enters and leaves the mesh softly.
//!
//! The relief of a gear begins `length` before the end of the path at its tip and reaches its amount C_a at that end:
//!
//! e(s) = C_a h(ξ), ξ = (s − s_hi)/length + 1 (planet) or (s_lo − s)/length + 1 (side gear)
//!
//! with h = 0 for ξ < 0 and h = 1 for ξ > 1, where only the relieved corner itself can touch. Between them, h is the
//! polynomial of least degree with two continuous derivatives at both joints, 10ξ³ − 15ξ⁴ + 6ξ⁵. Neither onset nor tip
//! therefore disturbs the integrator. A linear or parabolic relief, as ground in practice, would cause a kink of the
//! force at the tip or at the onset.

use super::ToothErrorSpec;
use crate::geometry::Pair;
use crate::numeric::{Jet, Scalar};

/// Tip relief of planet and side gear.
#[derive(Clone, Copy, Debug)]
pub struct TipRelief {
    /// Amounts C_a [m].
    amount: [f64; 2],
    /// Ends of the path as arcs from the pitch point toward each gear's own tip [rad].
    end: [f64; 2],
    per_length: f64,
}

/// h(ξ), which is 0 for ξ < 0 and 1 for ξ > 1, with its first two derivatives.
#[inline]
fn ramp(x: f64) -> [f64; 3] {
    if x <= 0.0 {
        [0.0; 3]
    } else if x >= 1.0 {
        [1.0, 0.0, 0.0]
    } else {
        let v = 1.0 - x;
        [x * x * x * (x * (x * 6.0 - 15.0) + 10.0), 30.0 * x * x * v * v, 60.0 * x * v * (v - x)]
    }
}

impl TipRelief {
    /// Returns the relief defined by `spec` on the teeth of `pair`, or `None`.
    pub fn new(spec: &ToothErrorSpec, pair: &Pair) -> Option<Self> {
        let amount = [spec.planet_tip_relief, spec.side_tip_relief];
        (amount != [0.0; 2]).then(|| Self {
            amount,
            end: [pair.path.high, -pair.path.low],
            per_length: 1.0 / (spec.relief_length * pair.base_pitch),
        })
    }

    /// Gap [m] at `s` [rad] with its slopes with respect to s.
    #[inline]
    pub fn gap(&self, s: f64) -> Jet {
        let mut gap = Jet::constant(0.0);
        for (i, way) in [1.0, -1.0].into_iter().enumerate() {
            let x = (way * s - self.end[i]) * self.per_length + 1.0;
            if x <= 0.0 || self.amount[i] == 0.0 {
                continue;
            }
            let [h, slope, curvature] = ramp(x);
            let (amount, per) = (self.amount[i], way * self.per_length);
            gap.v += amount * h;
            gap.d += amount * per * slope;
            gap.dd += amount * per * per * curvature;
        }
        gap
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::GearSpec;

    fn relief() -> (Pair, TipRelief, f64) {
        let spec = ToothErrorSpec { planet_tip_relief: 20e-6, side_tip_relief: 12e-6, ..ToothErrorSpec::default() };
        let pair = Pair::new(&GearSpec::default());
        (pair, TipRelief::new(&spec, &pair).unwrap(), spec.relief_length * pair.base_pitch)
    }

    #[test]
    fn relief_is_zero_before_its_onset_half_in_the_middle_and_full_at_and_beyond_the_tip() {
        let (pair, relief, length) = relief();
        let [low, high] = [pair.path.low, pair.path.high];
        for (s, e) in [
            (0.5 * (low + high), 0.0),
            (high - length, 0.0),
            (high - 0.5 * length, 10e-6),
            (high, 20e-6),
            (high + 0.1, 20e-6),
            (low + length, 0.0),
            (low + 0.5 * length, 6e-6),
            (low, 12e-6),
            (low - 0.1, 12e-6),
        ] {
            assert!((relief.gap(s).v - e).abs() < 1e-18, "{s} {:?} {e}", relief.gap(s));
        }
        assert!(TipRelief::new(&ToothErrorSpec::default(), &pair).is_none());
    }

    #[test]
    fn relief_is_twice_continuously_differentiable_and_monotonic_toward_the_tips() {
        let (pair, relief, length) = relief();
        let h = 1e-6 * length;
        let slope = |s: f64| relief.gap(s).d;
        for k in 0..=4000 {
            let s = pair.path.low - 0.1 + (pair.path.high - pair.path.low + 0.2) * f64::from(k) / 4000.0;
            let difference = (relief.gap(s + h).v - relief.gap(s - h).v) / (2.0 * h);
            assert!((slope(s) - difference).abs() < 1e-8, "{s}");
            let difference = (slope(s + h) - slope(s - h)) / (2.0 * h);
            assert!((relief.gap(s).dd - difference).abs() < 1e-5, "{s}");
            assert!(if s > 0.0 { slope(s) >= 0.0 } else { slope(s) <= 0.0 });
        }
        for s in [pair.path.high, pair.path.high - length, pair.path.low, pair.path.low + length] {
            // slope and curvature vanish at both sides of each joint: the third derivative of h is 60 at most
            let bound = 60.0 * 20e-6 / length.powi(3);
            assert!(slope(s - h).abs() <= bound * h * h && slope(s + h).abs() <= bound * h * h);
        }
    }
}

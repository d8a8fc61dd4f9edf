//! Change of dry friction with slip speed: a Stribeck curve that multiplies the limit torque.
//!
//! ```text
//! φ(v) = 1 + (s − 1) exp(−v/v_S) + k v
//! ```
//!
//! φ multiplies the kinetic torque. Its parameters are the speed v at the mean radius, the static ratio s, the Stribeck
//! speed v_S and the slope k. With v_S > 0, sliding begins at the breakaway torque. With v_S = 0, friction jumps from s
//! to 1. A falling φ causes judder and a rising φ damps it, because dT/dω = T_k r φ′(v). Friction never falls below a
//! fraction of its kinetic value ([`LEAST`]), which it approaches smoothly.
//!
//! Sources: L. C. Bo and D. Pavelescu, Wear 82 (1982), p. 277, with the exponent 1; the clutch of the Modelica Standard
//! Library, Mechanics.Rotational.Components.Clutch, for μ over slip.

use crate::friction::smooth;
use crate::numeric::Dual;

/// Smallest fraction of the kinetic value. Down to twice this fraction, the curve is unchanged.
const LEAST: f64 = 0.1;

/// Friction over its kinetic value, as a function of slip speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipLaw {
    /// Radius at which the surface slides [m].
    pub radius: f64,
    /// Static over kinetic value, minus 1.
    pub excess: f64,
    /// Stribeck speed v_S [m/s]; 0 = no curve.
    pub stribeck_speed: f64,
    /// Slope k over the kinetic value [s/m].
    pub slope: f64,
}

impl SlipLaw {
    /// True if speed has no influence.
    pub fn is_constant(&self) -> bool {
        (self.excess == 0.0 || self.stribeck_speed == 0.0) && self.slope == 0.0
    }

    /// φ and dφ/dω at the slip speed ω in the direction of sliding [rad/s].
    pub fn factor(&self, speed: f64) -> [f64; 2] {
        if self.is_constant() || speed <= 0.0 {
            let falls = self.stribeck_speed > 0.0;
            return [if falls { 1.0 + self.excess } else { 1.0 }, 0.0];
        }
        let v = self.radius * speed;
        let (mut value, mut slope) = (1.0 + self.slope * v, self.slope * self.radius);
        if self.stribeck_speed > 0.0 {
            let fall = self.excess * libm::exp(-v / self.stribeck_speed);
            (value, slope) = (value + fall, slope - fall * self.radius / self.stribeck_speed);
        }
        let held = smooth::floor(Dual { v: value, d: [slope] }, LEAST, LEAST);
        [held.v, held.d[0]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLUTCH: SlipLaw = SlipLaw { radius: 0.05, excess: 0.2, stribeck_speed: 0.1, slope: -0.01 };

    #[test]
    fn the_curve_matches_its_formula_and_its_slope_matches_differences() {
        for speed in [1e-3, 1.0, 20.0, 300.0] {
            let v = 0.05 * speed;
            let expected = 1.0 + 0.2 * (-v / 0.1_f64).exp() - 0.01 * v;
            let [value, slope] = CLUTCH.factor(speed);
            assert!((value - expected).abs() < 1e-14, "{value} for {expected}");
            let h = 1e-5 * speed;
            let difference = (CLUTCH.factor(speed + h)[0] - CLUTCH.factor(speed - h)[0]) / (2.0 * h);
            assert!((slope - difference).abs() < 1e-8 * (1.0 + slope.abs()), "{slope} for {difference}");
        }
    }

    #[test]
    fn the_curve_begins_at_the_static_value_and_never_falls_below_its_lower_limit() {
        assert_eq!(CLUTCH.factor(0.0), [1.2, 0.0]);
        assert!((CLUTCH.factor(1e-9)[0] - 1.2).abs() < 1e-9);
        assert_eq!(CLUTCH.factor(1e6), [LEAST, 0.0]);
        let jump = SlipLaw { stribeck_speed: 0.0, slope: 0.0, ..CLUTCH };
        assert_eq!(jump.factor(3.0), [1.0, 0.0]);
        let constant = SlipLaw { radius: 0.0, excess: 0.0, stribeck_speed: 0.0, slope: 0.0 };
        assert!(constant.is_constant() && jump.is_constant() && !CLUTCH.is_constant());
    }
}

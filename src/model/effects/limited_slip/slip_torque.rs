//! Torque of clutch packs that only resists slip and holds nothing: viscous shear, or a measured curve without
//! breakaway torque.
//!
//! ```text
//! viscous     T = T_v y |y|ⁿ⁻¹   regularised:   T = T_v y (y² + ε²)^((n − 1)/2),   y = s/s_v,   ε = 10⁻³
//! ```
//!
//! with the slip s of a side gear relative to the carrier. For n < 1, regularisation bounds the derivative by
//! T_v/s_v εⁿ⁻¹. It changes the torque by the fraction (n − 1)/2 (ε/y)², which is at most 0.005 % from y = 0.1. A measured
//! curve is an odd function of slip.
//!
//! Source of the power law: the shear of silicone oil between the plates of a viscous coupling; H. Naunheimer et al.,
//! Automotive Transmissions, 2nd ed., Springer 2011, section 10.2.

use crate::model::effect_kinds::{Action, BodyEffect, BodyMotion, Slopes, TorqueCurve};
use crate::numeric::pow;

/// Slip below which the torque becomes linear, over the reference slip.
const EPSILON: f64 = 1e-3;

/// Torque of sheared oil over slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscous {
    /// Torque T_v at the slip s_v [N·m].
    pub torque: f64,
    /// Slip s_v [rad/s].
    pub speed: f64,
    /// Exponent n.
    pub exponent: f64,
}

impl Viscous {
    /// Torque against the `slip` [rad/s] in its direction [N·m], and the derivative with respect to slip.
    fn at(&self, slip: f64) -> [f64; 2] {
        let y = slip / self.speed;
        let square = y * y + EPSILON * EPSILON;
        let per_slip = self.torque / self.speed * pow(square, 0.5 * (self.exponent - 1.0));
        let elasticity = 1.0 + (self.exponent - 1.0) * y * y / square;
        [per_slip * slip, per_slip * elasticity]
    }
}

/// Torque of both packs by slip.
#[derive(Clone, Copy, Debug)]
pub struct SlipTorque {
    /// Torque of sheared oil.
    pub viscous: Option<Viscous>,
    /// Measured torque that is zero without slip.
    pub curve: Option<TorqueCurve>,
    /// Index of the heat in the ledger.
    pub heat_index: usize,
}

impl SlipTorque {
    /// Torque against the `slip` [rad/s] in its direction [N·m], and the derivative with respect to slip.
    fn at(&self, slip: f64) -> [f64; 2] {
        let viscous = self.viscous.map_or([0.0; 2], |viscous| viscous.at(slip));
        let curve = self.curve.map_or([0.0; 2], |curve| {
            let [torque, slope] = curve.at(slip.abs());
            [torque.copysign(slip), slope]
        });
        [viscous[0] + curve[0], viscous[1] + curve[1]]
    }
}

impl BodyEffect for SlipTorque {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        let carrier = at.layout.carrier();
        for s in 0..2 {
            let slip = at.v[s] - at.v[carrier];
            let [torque, _] = self.at(slip);
            out.force[s] -= torque;
            out.force[carrier] += torque;
            out.heat[self.heat_index] += torque * slip;
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        let carrier = at.layout.carrier();
        for s in 0..2 {
            let [_, slope] = self.at(at.v[s] - at.v[carrier]);
            for (i, j, sign) in [(s, s, -1.0), (s, carrier, 1.0), (carrier, s, 1.0), (carrier, carrier, -1.0)] {
                out.velocity(i, j, sign * slope);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viscous_torque_follows_its_power_law_and_its_derivative_matches_differences() {
        for exponent in [0.3, 0.5, 1.0, 2.0] {
            let viscous = Viscous { torque: 80.0, speed: 10.0, exponent };
            for slip in [0.5, 3.0, 10.0, 400.0] {
                let [torque, slope] = viscous.at(slip);
                let law = 80.0 * (slip / 10.0_f64).powf(exponent);
                assert!((torque / law - 1.0).abs() < 2e-4, "{exponent} {slip}: {torque} for {law}");
                let h = 1e-6 * slip;
                let difference = (viscous.at(slip + h)[0] - viscous.at(slip - h)[0]) / (2.0 * h);
                assert!((slope / difference - 1.0).abs() < 1e-7, "{exponent} {slip}");
            }
        }
    }

    #[test]
    fn torque_is_odd_zero_at_rest_and_has_a_bounded_derivative() {
        let curve = TorqueCurve::new(&[[5.0, 40.0], [20.0, 60.0]]);
        let viscous = Some(Viscous { torque: 80.0, speed: 10.0, exponent: 0.3 });
        for both in [SlipTorque { viscous, curve, heat_index: 0 }, SlipTorque { viscous: None, curve, heat_index: 0 }] {
            for slip in [1e-9, 0.1, 7.0, 300.0] {
                let [[forward, slope], [backward, other]] = [both.at(slip), both.at(-slip)];
                assert!(forward == -backward && slope == other && forward > 0.0);
            }
            assert_eq!(both.at(0.0)[0], 0.0);
            // 80/10 · 1000^0.7 N·m·s/rad of the oil, and less than 20 of the curve
            assert!(both.at(0.0)[1] < 8.0 * 126.0 + 20.0);
        }
    }
}

//! Torque of clutch packs that only resists slip and holds nothing: viscous shear, or a measured curve without
//! breakaway torque.
//!
//! ```text
//! viscous     T = T_v y |y|ⁿ⁻¹   regularised:   T = T_v y (y² + ε²)^((n − 1)/2),   y = s/s_v,   ε = 10⁻³
//! ```
//!
//! with the slip s of a side gear relative to the carrier. For n < 1, regularisation bounds the derivative by T_v/s_v
//! εⁿ⁻¹. It changes the torque by the fraction (n − 1)/2 (ε/y)², which is at most 0.005 % from y = 0.1. A measured
//! curve is an odd function of slip.
//!
//! Source of the power law: the shear of silicone oil between the plates of a viscous coupling; H. Naunheimer et al.,
//! Automotive Transmissions, 2nd ed., Springer 2011, section 10.2.

use crate::model::effect_kinds::{Law, TorqueCurve};
use crate::model::scene::Viscosity;
use crate::numeric::Scalar;

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
    /// Torque against the `slip` [rad/s] in its direction [N·m].
    fn torque<T: Scalar>(&self, slip: T) -> T {
        let y = slip / T::constant(self.speed);
        let square = y * y + EPSILON * EPSILON;
        square.powf(0.5 * (self.exponent - 1.0)) * (self.torque / self.speed) * slip
    }
}

/// Torque of a pack by slip.
#[derive(Clone, Copy, Debug)]
pub struct SlipTorque {
    /// Torque of sheared oil.
    pub viscous: Option<Viscous>,
    /// Measured torque that is zero without slip.
    pub curve: Option<TorqueCurve>,
}

impl Law for SlipTorque {
    fn force<T: Scalar>(&self, _: T, slip: T, _: Option<Viscosity>) -> T {
        let viscous = self.viscous.map_or(T::constant(0.0), |viscous| viscous.torque(slip));
        let curve = self.curve.map_or(T::constant(0.0), |curve| {
            let [torque, slope] = curve.at(slip.value().abs());
            slip.through([torque.copysign(slip.value()), slope, 0.0])
        });
        viscous + curve
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::effect_kinds::element_tests::verify;
    use crate::numeric::Dual;

    #[test]
    fn viscous_torque_follows_its_power_law() {
        for exponent in [0.3, 0.5, 1.0, 2.0] {
            let viscous = Viscous { torque: 80.0, speed: 10.0, exponent };
            for slip in [0.5, 3.0, 10.0, 400.0] {
                let (torque, law) = (viscous.torque(slip), 80.0 * (slip / 10.0_f64).powf(exponent));
                assert!((torque / law - 1.0).abs() < 2e-4, "{exponent} {slip}: {torque} for {law}");
            }
        }
    }

    #[test]
    fn torque_is_zero_at_rest_and_its_law_is_consistent_with_a_bounded_derivative() {
        let curve = TorqueCurve::new(&[[5.0, 40.0], [20.0, 60.0]]);
        for exponent in [0.3, 0.5, 1.0, 2.0] {
            let viscous = Some(Viscous { torque: 80.0, speed: 10.0, exponent });
            for law in [SlipTorque { viscous, curve }, SlipTorque { viscous, curve: None }] {
                verify(&law, None, &[0.0], &[0.1, 3.0, 7.0, 300.0]);
                assert_eq!(law.force(0.0, 0.0, None), 0.0);
            }
        }
        // 80/10 · 1000^0.7 N·m·s/rad of the oil, and less than 20 of the curve
        let viscous = Some(Viscous { torque: 80.0, speed: 10.0, exponent: 0.3 });
        let at_rest = Dual::<2>::variable(0.0, 1);
        assert!(SlipTorque { viscous, curve }.force(at_rest, at_rest, None).d[1] < 8.0 * 126.0 + 20.0);
    }
}

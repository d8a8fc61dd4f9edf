//! Coulomb friction with a Stribeck peak: μ(v) = μ_k + (μ_s − μ_k) exp(−(v/v_S)²).
//!
//! Source: Armstrong-Hélouvry, Dupont and Canudas de Wit (1994), Automatica 30, p. 1083, with the Gaussian exponent 2:
//! in the square of v the coefficient is even and has all derivatives at zero.

use super::spec::{LARGEST, ToothFrictionSpec};
use crate::numeric::Scalar;

/// Coefficient at the sliding speed `v` [m/s] of either sign; without a peak it is a constant and costs nothing.
#[inline]
pub fn coefficient<T: Scalar>(spec: &ToothFrictionSpec, v: T) -> T {
    let kinetic = spec.coefficient.clamp(0.0, LARGEST);
    let peak = (kinetic * spec.static_ratio).clamp(0.0, LARGEST) - kinetic;
    if peak == 0.0 {
        return T::constant(kinetic);
    }
    let ratio = v * (1.0 / spec.stribeck_speed.max(1e-9));
    (-(ratio * ratio)).exp() * peak + kinetic
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peak_falls_from_static_to_kinetic() {
        let spec = ToothFrictionSpec {
            coefficient: 0.06,
            static_ratio: 1.5,
            stribeck_speed: 0.02,
            ..ToothFrictionSpec::default()
        };
        let at = |v: f64| coefficient(&spec, v);
        assert!((at(0.0) - 0.09).abs() < 1e-15);
        // one e-th of the peak of 0.03 is left at v_S: 0.03/2.718281828459045 = 0.01103638323514327
        assert!((at(0.02) - 0.07103638323514327).abs() < 1e-15);
        assert_eq!(at(-0.02), at(0.02));
        assert!((at(1.0) - 0.06).abs() < 1e-15);
    }
}

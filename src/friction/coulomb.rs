//! Coulomb friction with a Stribeck peak: μ(v) = μ_k + (μ_s − μ_k) exp(−(v/v_S)²).
//!
//! Source: Armstrong-Hélouvry, Dupont and Canudas de Wit (1994), Automatica 30, p. 1083, with the Gaussian exponent 2.
//! As a function of v², the coefficient is even and has all derivatives at zero.

use super::{LARGEST, ToothFrictionSpec};
use crate::numeric::Scalar;

/// Coefficient at the sliding speed `v` [m/s] of either sign. Without a peak it is a constant without extra work.
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

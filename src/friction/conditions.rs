//! Operating conditions of a contact, and their limits for the laws.

use super::smooth;
use crate::numeric::{PI, Scalar};

/// Limit of speeds [m/s], which keeps squares finite.
const FASTEST: f64 = 1e6;

/// Bounds of the line load [N/m]. They have no effect from 1.5 times the lower to half of the upper bound.
const LINE_LOAD: [f64; 2] = [1e3, 1e9];
/// Bounds of the relative radius of curvature [m], smoothed in the same way.
const RADIUS: [f64; 2] = [1e-4, 1e2];

/// Bounds of the modulus [Pa]: softer than rubber, harder than diamond.
const MODULUS: [f64; 2] = [1e5, 1e13];

/// Operating conditions of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions<T> {
    /// Sliding speed u₁ − u₂ [m/s], signed.
    pub sliding: T,
    /// Sum speed v_Σ = u₁ + u₂ of the surfaces past the contact [m/s], of either sign; the entraining speed is half of
    /// it.
    pub sum_speed: T,
    /// Line load w: normal force per width [N/m].
    pub line_load: T,
    /// Relative radius of curvature ρ, 1/ρ = 1/ρ₁ + 1/ρ₂ [m].
    pub radius: T,
    /// Contact modulus E*, 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ [Pa].
    pub modulus: f64,
}

impl<T: Scalar> Conditions<T> {
    /// Maximum pressure of the Hertzian line contact p_H = √(w E*/(π ρ)) [Pa].
    pub fn pressure(&self) -> T {
        (self.line_load / self.radius * (self.modulus / PI)).sqrt()
    }

    /// Returns positive, bounded magnitudes, which are valid arguments of every law. `slowest` is v_ε [m/s].
    pub(super) fn regularised(&self, slowest: f64) -> Self {
        Self {
            sliding: magnitude(limited(self.sliding), slowest),
            sum_speed: magnitude(limited(self.sum_speed), slowest),
            line_load: smooth::hold(self.line_load, LINE_LOAD),
            radius: smooth::hold(self.radius, RADIUS),
            modulus: self.modulus.clamp(MODULUS[0], MODULUS[1]),
        }
    }
}

/// √(v² + v_ε²), where v_ε is `slowest`.
#[inline]
pub(super) fn magnitude<T: Scalar>(v: T, slowest: f64) -> T {
    (v * v + slowest * slowest).sqrt()
}

/// Limits `v` to ±[`FASTEST`].
#[inline]
pub(super) fn limited<T: Scalar>(v: T) -> T {
    if v.value().abs() < FASTEST { v } else { T::constant(FASTEST.copysign(v.value())) }
}

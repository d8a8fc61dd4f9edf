//! Tooth friction: coefficient from sliding speed, rolling speed and load of a contact, signed and smooth. One law a file;
//! the forces that follow from it belong to `contact`.
//!
//! The magnitude of the sliding speed enters every law as v_m = √(v² + v_ε²), and the sign as v/v_m. So the signed
//! coefficient
//!
//! ```text
//! h(v) = μ(v_m) · v / v_m
//! ```
//!
//! is odd and has all derivatives through v = 0, with the slope μ(v_ε)/v_ε there, and no law is
//! evaluated at its singularity at zero sliding. The root is preferred to tanh(v/v_ε): it needs no exponential, applies to
//! law and sign at once, and differs from Coulomb's step by (v_ε/v)²/2 only, 5e-5 at a hundred v_ε. It does not stick: a
//! flank under load creeps at v_ε times the fraction of the friction limit that it carries.
//!
//! Loads, radii and speeds far outside the range of gears are limited (see [`smooth`]), so that the coefficient is finite
//! and lies within ±[`LARGEST`] for all finite arguments. [`outside`] reports arguments outside a law's published range.

pub mod benedict_kelley;
pub mod coulomb;
pub mod iso14179;
mod range;
pub mod smooth;
mod spec;
pub mod xu_kahraman;

use crate::numeric::Scalar;

pub use range::Outside;
pub use spec::{FrictionLaw, ToothFrictionSpec};

/// Largest coefficient any law may return: that of unlubricated steel starts beyond it.
pub const LARGEST: f64 = 0.3;

/// Width of the transition below [`LARGEST`]: coefficients up to 0.2 stay unchanged.
const NEAR_LARGEST: f64 = 0.1;

/// Limit of speeds [m/s]; keeps squares finite.
const FASTEST: f64 = 1e6;

/// Bounds of line load [N/m] and curvature radius [m]; from 1.5 times the lower to half of the upper they have no effect.
const LINE_LOAD: [f64; 2] = [1e3, 1e9];
const RADIUS: [f64; 2] = [1e-4, 1e2];

/// Bounds of the modulus [Pa]: softer than rubber, harder than diamond.
const MODULUS: [f64; 2] = [1e5, 1e13];

/// Operating conditions of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions<T> {
    /// Sliding speed u₁ − u₂ [m/s], signed.
    pub sliding: T,
    /// Sum speed v_Σ = u₁ + u₂ of the surfaces past the contact [m/s], of either sign; the entraining speed is half of it.
    pub rolling: T,
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
        (self.line_load / self.radius * (self.modulus / crate::numeric::PI)).sqrt()
    }

    /// The same with positive magnitudes in place of signed or vanishing ones: arguments valid for every law.
    fn regularised(&self, slowest: f64) -> Self {
        Self {
            sliding: magnitude(limited(self.sliding), slowest),
            rolling: magnitude(limited(self.rolling), slowest),
            line_load: smooth::hold(self.line_load, LINE_LOAD),
            radius: smooth::hold(self.radius, RADIUS),
            modulus: self.modulus.clamp(MODULUS[0], MODULUS[1]),
        }
    }
}

/// √(v² + v_ε²).
#[inline]
fn magnitude<T: Scalar>(v: T, slowest: f64) -> T {
    (v * v + slowest * slowest).sqrt()
}

/// `v`, or ±[`FASTEST`] beyond.
#[inline]
fn limited<T: Scalar>(v: T) -> T {
    if v.value().abs() < FASTEST { v } else { T::constant(FASTEST.copysign(v.value())) }
}

/// Signed coefficient of friction h: the friction force on surface 1 is −h times the normal force, and its heat
/// h·v times the normal force is never negative. Odd in the sliding speed, within ±[`LARGEST`].
pub fn signed_coefficient<T: Scalar>(spec: &ToothFrictionSpec, conditions: &Conditions<T>) -> T {
    let slowest = spec.slowest();
    if spec.law == FrictionLaw::CoulombStribeck {
        let v = limited(conditions.sliding);
        return coulomb::coefficient(spec, v) * (v / magnitude(v, slowest));
    }
    let at = conditions.regularised(slowest);
    let published = match spec.law {
        FrictionLaw::BenedictKelley => benedict_kelley::coefficient(spec, &at),
        FrictionLaw::Iso14179 => iso14179::coefficient(spec, &at),
        _ => xu_kahraman::coefficient(spec, &at),
    };
    smooth::ceiling(published, LARGEST, NEAR_LARGEST) * (limited(conditions.sliding) / at.sliding)
}

/// The first quantity that lies outside the range the chosen law was published for, if any.
///
/// Every mesh passes the pitch point, where the sliding speed is zero and no law was measured; that alone is not reported.
pub fn outside(spec: &ToothFrictionSpec, conditions: &Conditions<f64>) -> Option<Outside> {
    match spec.law {
        FrictionLaw::CoulombStribeck => None,
        law => {
            let at = conditions.regularised(spec.slowest());
            match law {
                FrictionLaw::BenedictKelley => benedict_kelley::outside(spec, &at),
                FrictionLaw::Iso14179 => iso14179::outside(&at),
                _ => xu_kahraman::outside(spec, &at),
            }
        }
    }
}

#[cfg(test)]
mod tests;

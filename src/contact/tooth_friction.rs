//! Friction along the flanks of a tooth pair, by one of the laws of `friction`.

use crate::friction::{Conditions, ToothFrictionSpec, outside, signed_coefficient};
use crate::numeric::Scalar;

/// Sliding of two flanks on each other.
#[derive(Clone, Copy, Debug)]
pub struct Sliding<T> {
    /// Sliding speed, with sign [m/s].
    pub sliding: T,
    /// Sum of both flanks' speeds along the profile, with sign [m/s].
    pub sum_speed: T,
    /// Load per width [N/m].
    pub load: T,
    /// Relative radius of curvature of both flanks [m].
    pub radius: T,
}

/// Friction of the flanks of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct ToothFriction {
    /// Law, lubricant and surface.
    pub spec: ToothFrictionSpec,
    /// E* of the contact [Pa].
    pub modulus: f64,
}

impl ToothFriction {
    /// Returns the friction with the viscosity `oil_viscosity` [Pa·s], unless the user gave a viscosity.
    pub fn with_viscosity(self, oil_viscosity: f64) -> Self {
        if !self.spec.viscosity_from_oil {
            return self;
        }
        Self { spec: ToothFrictionSpec { oil_viscosity, ..self.spec }, ..self }
    }

    /// Coefficient of friction with the sign of the sliding speed.
    #[inline]
    pub fn signed<T: Scalar>(&self, at: &Sliding<T>) -> T {
        signed_coefficient(&self.spec, &self.conditions(at))
    }

    /// The first quantity outside the published range of the law, or `None`.
    pub fn outside(&self, at: &Sliding<f64>) -> Option<String> {
        outside(&self.spec, &self.conditions(at)).map(|outside| outside.to_string())
    }

    #[inline]
    fn conditions<T: Scalar>(&self, at: &Sliding<T>) -> Conditions<T> {
        Conditions {
            sliding: at.sliding,
            sum_speed: at.sum_speed.abs(),
            line_load: at.load,
            radius: at.radius,
            modulus: self.modulus,
        }
    }
}

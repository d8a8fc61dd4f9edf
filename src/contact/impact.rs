//! Adams IMPACT: F = K d^e + c(d) ḋ with c(d) = C·STEP(d, 0, 0, d_max, 1), and F ≥ 0.
//!
//! Source: MSC Adams function reference, IMPACT and STEP. STEP is the cubic u²(3 − 2u). The elastic part is the
//! derivative of U(d) = K d^(e+1) / (e+1).

use super::Damping;
use crate::numeric::{pow, sqrt};

/// Force of one tooth pair with its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Force {
    /// Total force F [N], never negative.
    pub total: f64,
    /// Elastic part F_el = U′(d) [N].
    pub elastic: f64,
    /// ∂F/∂d [N/m].
    pub by_depth: f64,
    /// ∂F/∂ḋ [N·s/m].
    pub by_rate: f64,
}

/// Constants of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// K [N/m^e].
    pub stiffness: f64,
    /// e.
    pub exponent: f64,
    /// C [N·s/m].
    pub damping: f64,
    /// 1/d_max [1/m]: damping is full at the depth d_max.
    pub per_full_depth: f64,
}

impl Impact {
    /// d^(e−1) for d > 0. The common exponents, multiples of ½, use multiplications and roots.
    #[inline(always)]
    fn power(&self, d: f64) -> f64 {
        match self.exponent {
            1.5 => sqrt(d),
            1.0 => 1.0,
            2.0 => d,
            2.5 => d * sqrt(d),
            3.0 => d * d,
            e => pow(d, e - 1.0),
        }
    }

    /// Force at penetration `d` > 0 [m] and rate `rate` [m/s].
    #[inline(always)]
    pub fn force(&self, d: f64, rate: f64) -> Force {
        let damping = Damping::Step { coefficient: self.damping, per_full_depth: self.per_full_depth };
        self.damped_by(&damping, d, rate)
    }

    /// Force with `damping` instead of the law's own damping.
    #[inline(always)]
    pub fn damped_by(&self, damping: &Damping, d: f64, rate: f64) -> Force {
        // F_el/d
        let secant = self.stiffness * self.power(d);
        damping.apply(secant * d, self.exponent * secant, d, rate)
    }

    /// Elastic energy U [J] at penetration `d` > 0 [m].
    #[inline(always)]
    pub fn energy(&self, d: f64) -> f64 {
        self.stiffness * self.power(d) * d * d / (self.exponent + 1.0)
    }
}

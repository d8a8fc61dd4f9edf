//! Adams IMPACT: F = K d^e + c(d) ḋ with c(d) = C·STEP(d, 0, 0, d_max, 1), and F ≥ 0.
//!
//! Source: MSC Adams function reference, IMPACT and STEP; STEP is the cubic u²(3 − 2u). The elastic part derives from
//! U(d) = K d^(e+1) / (e+1).

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
    /// 1/d_max [1/m].
    pub per_full_depth: f64,
}

impl Impact {
    /// d^(e−1) for d > 0: multiplications and roots where the exponent is a multiple of ½, which most laws have.
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
        let power = self.stiffness * self.power(d);
        let elastic = power * d;
        let u = d * self.per_full_depth;
        let (step, slope) =
            if u < 1.0 { (u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) * self.per_full_depth) } else { (1.0, 0.0) };
        let total = elastic + self.damping * step * rate;
        if total <= 0.0 {
            return Force { elastic, ..Force::default() };
        }
        Force {
            total,
            elastic,
            by_depth: self.exponent * power + self.damping * slope * rate,
            by_rate: self.damping * step,
        }
    }

    /// Elastic energy U [J] at penetration `d` > 0 [m].
    #[inline(always)]
    pub fn energy(&self, d: f64) -> f64 {
        self.stiffness * self.power(d) * d * d / (self.exponent + 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_and_energy_belong_together_and_derivatives_are_exact() {
        for exponent in [1.0, 1.3, 1.5, 2.0, 2.2] {
            let law = Impact { stiffness: 3e9, exponent, damping: 4e4, per_full_depth: 1e4 };
            for d in [1e-6, 3e-5, 9e-5, 2e-4] {
                for rate in [-1e-3, 0.0, 0.05] {
                    let h = d * 1e-5;
                    let f = law.force(d, rate);
                    let work = (law.energy(d + h) - law.energy(d - h)) / (2.0 * h);
                    assert!((f.elastic / work - 1.0).abs() < 1e-8);
                    if f.total > 0.0 {
                        let by_depth = (law.force(d + h, rate).total - law.force(d - h, rate).total) / (2.0 * h);
                        assert!((f.by_depth - by_depth).abs() < 1e-6 * by_depth.abs());
                        let by_rate = (law.force(d, rate + 1e-6).total - f.total) / 1e-6;
                        assert!((f.by_rate - by_rate).abs() < 1e-6 * (1.0 + by_rate));
                    }
                }
            }
        }
    }
}

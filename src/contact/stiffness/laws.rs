//! Two laws of a tooth pair derived from its compliance: linear, or with a Hertz part that depends on the load.
//!
//! Slices of a straight bevel pair are similar, so with a line load w = ωR the deflection is Rp at every R. The arc is
//! p = ω q(ω, s) with q = Q(s) − B ln(ω/ω₀), because the Hertz half-width b grows with √ω. Q is the compliance at ω₀.
//! Both laws return the elastic response per ∫R²dR, with the energy Φ. Multiplied by (R_e³ − R_i³)/3, it is the
//! response of the pair, with the torque ω∫R²dR.
//!
//! * [`Line`]: q at a fixed load, Φ = p²/2q.
//! * [`LineWeber`]: with v = q/B, the load is ω = p/(Bv), where v − ln v = Q/B − ln(p/(ω₀B)) (Lambert's W₋₁), and
//!   Φ = ∫ω dp = ½pω(1 − 1/(2v)), ∂²Φ/∂p² = 1/(B(v − 1)), ∂Φ/∂s = −½ω²Q′. Above ω₀, p(ω) continues along its
//!   tangent, because b exceeds half the depth to the teeth's middles and the logarithm is meaningless.

use std::sync::Arc;

use super::table::ComplianceTable;
use crate::contact::{Elastic, Spring};
use crate::numeric::Jet;

/// Compliance independent of the load: its Hertz part is that of a reference load.
#[derive(Clone, Debug)]
pub struct Line {
    pub(super) table: Arc<ComplianceTable>,
    /// Compliance q at the reference load minus Q, the same at every position [1/Pa].
    pub(super) shift: f64,
}

impl Line {
    /// Compliance q at position `s` [1/Pa].
    pub fn compliance(&self, s: f64) -> f64 {
        self.table.at(s).v + self.shift
    }
}

impl Spring for Line {
    /// 1/q, and the slopes of q.
    type Local = [f64; 3];

    #[inline(always)]
    fn is_linear(&self) -> bool {
        true
    }

    #[inline(always)]
    fn local(&self, s: f64) -> [f64; 3] {
        let q = self.table.at(s);
        [1.0 / (q.v + self.shift), q.d, q.dd]
    }

    #[inline(always)]
    fn respond(&self, &[c, by_s, by_s_twice]: &[f64; 3], p: f64) -> Elastic {
        let load = c * p;
        let arc_by_s = load * by_s;
        Elastic {
            energy: 0.5 * p * load,
            torque: load,
            stiffness: c,
            by_s: -0.5 * load * arc_by_s,
            torque_by_s: -c * arc_by_s,
            by_s_twice: c * arc_by_s * arc_by_s - 0.5 * load * load * by_s_twice,
        }
    }
}

/// Compliance whose Hertz part depends on the present load.
#[derive(Clone, Debug)]
pub struct LineWeber {
    table: Arc<ComplianceTable>,
    /// B = 2(1−ν²)/(πE) [1/Pa].
    hertz: f64,
    /// ω₀, line load per cone distance up to which the logarithm is valid [N/m²].
    limit: f64,
    per_hertz: f64,
    per_limit: f64,
}

/// Maximum number of iterations for v; one suffices, near ω₀ two.
const ITERATIONS: usize = 4;
/// A relative correction below this leaves an error of its fourth power.
const CONVERGED: f64 = 1e-4;

/// ln of a positive normal number within 2e-4, from the exponent and a quartic in the mantissa.
#[inline]
fn rough_ln(x: f64) -> f64 {
    let bits = x.to_bits();
    let exponent = (bits >> 52) as i64 - 1023;
    let m = f64::from_bits(bits & ((1 << 52) - 1) | 1.0f64.to_bits());
    let mantissa = -1.741_793_9 + m * (2.821_202_6 + m * (-1.469_956_8 + m * (0.447_179_55 - 0.056_570_851 * m)));
    exponent as f64 * std::f64::consts::LN_2 + mantissa
}

/// v > 1 with v − ln v = `ratio` − ln `x` > 1. After an asymptotic start, the fourth-order iteration by F. N. Fritsch,
/// R. E. Shafer, W. P. Crowley (Algorithm 443, CACM 16, 1973) needs one logarithm per step.
#[inline]
fn compliance_ratio(ratio: f64, x: f64) -> f64 {
    let k = ratio - rough_ln(x);
    let l = rough_ln(k);
    let mut v = k + l + l / k * (1.0 + (1.0 - 0.5 * l) / k);
    for _ in 0..ITERATIONS {
        let z = v - ratio + libm::log(x / v);
        let w = 1.0 - v;
        let q = 2.0 * w * (w + 2.0 / 3.0 * z);
        let correction = z * (q - z) / (w * (q - 2.0 * z));
        v += v * correction;
        if correction.abs() < CONVERGED {
            break;
        }
    }
    v
}

impl LineWeber {
    pub(super) fn new(table: Arc<ComplianceTable>, hertz: f64, limit: f64) -> Self {
        Self { table, hertz, limit, per_hertz: 1.0 / hertz, per_limit: 1.0 / limit }
    }

    /// Load ω = w/R [N/m²] at penetration arc `p` > 0 [rad] and compliance Q = `q` [1/Pa], and the tangent dω/dp. The
    /// last value is true if the logarithm is valid.
    fn load(&self, p: f64, q: f64) -> (f64, f64, bool) {
        let ratio = q * self.per_hertz;
        let x = p * self.per_hertz * self.per_limit;
        if x < ratio {
            let v = compliance_ratio(ratio, x);
            (p * self.per_hertz / v, self.per_hertz / (v - 1.0), true)
        } else {
            let tangent = self.per_hertz / (ratio - 1.0);
            ((p - self.limit * self.hertz) * tangent, tangent, false)
        }
    }
}

impl Spring for LineWeber {
    /// Q with its slopes.
    type Local = Jet;

    #[inline(always)]
    fn local(&self, s: f64) -> Jet {
        self.table.at(s)
    }

    #[inline(always)]
    fn respond(&self, q: &Jet, p: f64) -> Elastic {
        if p <= 0.0 {
            return Elastic::default();
        }
        let (load, tangent, logarithmic) = self.load(p, q.v);
        // Φ = ωp − ∫p dω
        let energy = if logarithmic {
            0.5 * p * load - 0.25 * self.hertz * load * load
        } else {
            let limit = self.hertz * self.limit;
            0.5 * load * (p - limit) + 0.25 * limit * self.limit
        };
        let arc_by_s = load * q.d;
        Elastic {
            energy,
            torque: load,
            stiffness: tangent,
            by_s: -0.5 * load * arc_by_s,
            torque_by_s: -tangent * arc_by_s,
            by_s_twice: tangent * arc_by_s * arc_by_s - 0.5 * load * load * q.dd,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rough_logarithm_is_accurate_enough_for_a_start() {
        for j in 0..2700 {
            let x = 1e-300 * libm::exp(0.25 * f64::from(j));
            assert!((rough_ln(x) - libm::log(x)).abs() < 2e-4, "{x:e}");
        }
    }

    #[test]
    fn the_ratio_solves_its_equation_from_the_limit_to_the_smallest_load() {
        for ratio in [2.5, 4.0, 8.0, 25.0] {
            for j in 0..3000 {
                let x = ratio * libm::exp(-0.2 * f64::from(j));
                let v = compliance_ratio(ratio, x);
                assert!((v - ratio + libm::log(x / v)).abs() < 4e-16 * (v + ratio), "{ratio} {x:e}: {v}");
            }
        }
    }
}

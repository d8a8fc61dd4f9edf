//! Damping of a tooth pair on top of any elastic law, and the resulting coefficient of restitution.
//!
//! `Step` is the damping of Adams IMPACT, C·STEP(d, 0, 0, d_max, 1)·ḋ, independent of the elastic force. `HuntCrossley`
//! is F = F_el (1 + λ ḋ). It starts and ends at zero with the elastic force, so no impact begins with a jump. Neither
//! law lets the flanks pull: F ≥ 0.
//!
//! # Restitution
//!
//! A free mass under F = F_el (1 + λ ḋ) has v dv/(1 + λ v) = −F_el/m dd. The right side returns to zero with d.
//! Therefore the left side integrates to zero between the speed v₀ of approach and the speed e v₀ of separation, for
//! any elastic law. With D = λ v₀,
//!
//! ```text
//! D − ln(1 + D) = −e D − ln(1 − e D).
//! ```
//!
//! Because e D < 1, a body separates at less than 1/λ for any speed of approach, and D grows without bound as e falls
//! to zero.
//!
//! Source: Hunt, Crossley (1975), J. Appl. Mech. 42, p. 440, for the force; Marhefka, Orin (1999), IEEE Trans. Syst.
//! Man Cybern. A 29, p. 566, for the integration. The known λ = 3(1 − e)/(2 v₀) is its limit for e → 1.

use super::impact::Force;
use crate::problem::Problem;

/// Smallest accepted coefficient of restitution; D is 20 there.
const MIN_RESTITUTION: f64 = 0.05;

/// Damping law of a tooth pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// Damping that grows with the penetration d by the cubic step u²(3 − 2u), u = d/d_max.
    Step {
        /// C at full penetration [N·s/m].
        coefficient: f64,
        /// 1/d_max [1/m].
        per_full_depth: f64,
    },
    /// Damping in proportion to the elastic force: F = F_el (1 + λ ḋ).
    HuntCrossley {
        /// λ [s/m].
        lambda: f64,
    },
}

impl Damping {
    /// No damping.
    pub const NONE: Self = Self::HuntCrossley { lambda: 0.0 };

    /// Returns this law in arcs, torques and rates about the pole of the plane of action, per unit of `weight`, for a
    /// face whose force acts at the cone distance `cone` [m].
    pub fn in_arcs(&self, cone: f64, weight: f64) -> Self {
        match *self {
            Damping::Step { coefficient, per_full_depth } => {
                Damping::Step { coefficient: coefficient * cone * cone / weight, per_full_depth: per_full_depth * cone }
            }
            Damping::HuntCrossley { lambda } => Damping::HuntCrossley { lambda: lambda * cone },
        }
    }

    /// Force with derivatives at penetration `d` > 0 [m] and rate `rate` [m/s]. `elastic` is the elastic force [N],
    /// `stiffness` its derivative ∂F_el/∂d [N/m].
    #[inline(always)]
    pub fn apply(&self, elastic: f64, stiffness: f64, d: f64, rate: f64) -> Force {
        let (total, by_depth, by_rate) = match *self {
            Damping::Step { coefficient, per_full_depth } => {
                let u = d * per_full_depth;
                let (step, slope) =
                    if u < 1.0 { (u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) * per_full_depth) } else { (1.0, 0.0) };
                (elastic + coefficient * step * rate, stiffness + coefficient * slope * rate, coefficient * step)
            }
            Damping::HuntCrossley { lambda } => {
                let factor = 1.0 + lambda * rate;
                (elastic * factor, stiffness * factor, elastic * lambda)
            }
        };
        if total <= 0.0 {
            return Force { elastic, ..Force::default() };
        }
        Force { total, elastic, by_depth, by_rate }
    }
}

/// (x − ln(1 + x))/x², computed by its series if the difference would lose digits.
fn excess(x: f64) -> f64 {
    if x.abs() > 0.1 {
        return (x - libm::log1p(x)) / (x * x);
    }
    // ½ − x/3 + x²/4 − … up to x¹⁷/19, below the last digit
    (2..20).rev().fold(0.0, |sum, n| 1.0 / f64::from(n) - x * sum)
}

/// Difference of both sides of the restitution relation, divided by D². For D from 0 to 1/e, it falls from (1 − e²)/2
/// to −∞ and has one zero.
fn balance(damping: f64, e: f64) -> f64 {
    excess(damping) - e * e * excess(-e * damping)
}

/// Root in (`low`, `high`) of a function that falls through zero once. Secant steps stay inside a shrinking bracket,
/// with bisection if they converge slowly.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut at_low, mut at_high) = (f(low), f(high));
    for round in 0..200 {
        let secant = low + (high - low) * (at_low / (at_low - at_high));
        let middle = 0.5 * (low + high);
        let x = if round % 3 != 2 && secant > low && secant < high { secant } else { middle };
        if x <= low || x >= high {
            break;
        }
        let y = f(x);
        if y > 0.0 {
            (low, at_low) = (x, y);
        } else {
            (high, at_high) = (x, y);
        }
    }
    if at_high.abs() <= at_low.abs() { high } else { low }
}

/// Returns the D = λ v₀ that results in the coefficient of restitution `restitution`, from 0.05 to 1.
pub fn dimensionless_damping(restitution: f64) -> Result<f64, Problem> {
    if !(MIN_RESTITUTION..=1.0).contains(&restitution) {
        return Err(problem!(
            "contact.restitution",
            "{restitution} is out of range; allowed {MIN_RESTITUTION} to 1. Below, Hunt and Crossley's law needs \
             damping without bound, since it never stops a body completely"
        ));
    }
    if restitution == 1.0 {
        return Ok(0.0);
    }
    Ok(root(0.0, 1.0 / restitution, |damping| balance(damping, restitution)))
}

/// Coefficient of restitution of an impact with D = λ v₀ ≥ 0.
pub fn restitution(damping: f64) -> f64 {
    if damping <= 0.0 {
        return 1.0;
    }
    root(0.0, f64::min(1.0, 1.0 / damping), |e| balance(damping, e))
}

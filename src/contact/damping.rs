//! Damping of a tooth pair on top of any elastic law, and the resulting coefficient of restitution.
//!
//! `Step` is the damping of Adams IMPACT, C·STEP(d, 0, 0, d_max, 1)·ḋ, independent of the elastic force.
//! `HuntCrossley` is F = F_el (1 + λ ḋ): it starts and ends at zero with the elastic force, so that no impact begins with
//! a jump. Neither lets the flanks pull: F ≥ 0.
//!
//! # Restitution
//!
//! A free mass under F = F_el (1 + λ ḋ) has v dv/(1 + λ v) = −F_el/m dd. The right side returns to zero with d, so between
//! the speeds v₀ in and e v₀ out the left side integrates to zero, whatever the elastic law: with D = λ v₀
//!
//! ```text
//! D − ln(1 + D) = −e D − ln(1 − e D).
//! ```
//!
//! As e D < 1, a body leaves at less than 1/λ however fast it came, and D grows without bound as e falls to zero.
//!
//! Source: Hunt, Crossley (1975), J. Appl. Mech. 42, p. 440, for the force; Marhefka, Orin (1999), IEEE Trans. Syst. Man
//! Cybern. A 29, p. 566, for the integration. The known λ = 3(1 − e)/(2 v₀) is its limit for e → 1.

use super::impact::Force;
use crate::problem::Problem;

/// Smallest coefficient of restitution accepted: D is 20 there.
const LEAST_RESTITUTION: f64 = 0.05;

/// Damping law of a tooth pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// Growing with penetration by the cubic step u²(3 − 2u).
    Step {
        /// C at full penetration [N·s/m].
        coefficient: f64,
        /// 1/d_max [1/m].
        per_full_depth: f64,
    },
    /// In proportion to the elastic force.
    HuntCrossley {
        /// λ [s/m].
        lambda: f64,
    },
}

impl Damping {
    /// No damping.
    pub const NONE: Self = Self::HuntCrossley { lambda: 0.0 };

    /// The same law for arcs, torques and rates about the pole of the plane of action, per unit of `weight`, of a face
    /// whose force acts at the cone distance `cone` [m].
    pub fn in_arcs(&self, cone: f64, weight: f64) -> Self {
        match *self {
            Damping::Step { coefficient, per_full_depth } => {
                Damping::Step { coefficient: coefficient * cone * cone / weight, per_full_depth: per_full_depth * cone }
            }
            Damping::HuntCrossley { lambda } => Damping::HuntCrossley { lambda: lambda * cone },
        }
    }

    /// Force with derivatives from the elastic force `elastic` [N] and its stiffness ∂F_el/∂d [N/m] at penetration `d` > 0
    /// [m] and rate `rate` [m/s].
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

/// (x − ln(1 + x))/x², by its series where the difference would lose digits.
fn excess(x: f64) -> f64 {
    if x.abs() > 0.1 {
        return (x - libm::log1p(x)) / (x * x);
    }
    // ½ − x/3 + x²/4 − … up to x¹⁷/19, below the last digit
    (2..20).rev().fold(0.0, |sum, n| 1.0 / f64::from(n) - x * sum)
}

/// Balance of the relation over D²; falls through zero once for D from 0 to 1/e, from (1 − e²)/2 to −∞.
fn balance(damping: f64, e: f64) -> f64 {
    excess(damping) - e * e * excess(-e * damping)
}

/// The root in (`low`, `high`) of a function that falls through zero once: secant steps kept inside a shrinking bracket,
/// with bisection where they converge slowly.
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

/// D = λ v₀ that makes the coefficient of restitution `restitution`, from 0.05 to 1.
pub fn dimensionless_damping(restitution: f64) -> Result<f64, Problem> {
    if !(LEAST_RESTITUTION..=1.0).contains(&restitution) {
        return Err(Problem::new(
            "contact.restitution",
            format!(
                "{restitution} is out of range; allowed {LEAST_RESTITUTION} to 1. Below, Hunt and Crossley's law needs \
                 damping without bound, since it never stops a body completely"
            ),
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

#[cfg(test)]
mod tests {
    use super::super::impact::Impact;
    use super::*;

    fn golden() -> serde_json::Value {
        serde_json::from_str(include_str!("../../tests/data/golden_contact_bench.json")).unwrap()
    }

    #[test]
    fn step_damping_equals_that_of_impact_bit_for_bit() {
        for exponent in [1.0, 1.3, 1.5, 2.0, 2.5] {
            let law = Impact { stiffness: 3e9, exponent, damping: 4e4, per_full_depth: 1e4 };
            let damping = Damping::Step { coefficient: law.damping, per_full_depth: law.per_full_depth };
            for d in [1e-9, 1e-6, 3.3e-5, 9e-5, 1e-4, 2e-4] {
                for rate in [-3.0, -1e-3, 0.0, 0.05, 2.0] {
                    let f = law.force(d, rate);
                    // at rest the derivative by depth is the elastic one
                    let stiffness = law.force(d, 0.0).by_depth;
                    assert_eq!(damping.apply(f.elastic, stiffness, d, rate), f);
                }
            }
        }
    }

    #[test]
    fn derivatives_are_exact_and_flanks_never_pull() {
        let (k, n) = (2e10, 1.5);
        let laws = [Damping::Step { coefficient: 4e4, per_full_depth: 1e4 }, Damping::HuntCrossley { lambda: 1.7 }];
        for law in laws {
            let force = |d: f64, rate: f64| law.apply(k * d.powf(n), k * n * d.powf(n - 1.0), d, rate);
            for d in [1e-6, 4e-5, 2e-4] {
                for rate in [-5.0, -0.6, -0.1, 0.0, 0.3, 2.0] {
                    let f = force(d, rate);
                    assert!(f.total >= 0.0);
                    if f.total > 0.0 {
                        let h = 1e-5;
                        let by_depth =
                            (force(d * (1.0 + h), rate).total - force(d * (1.0 - h), rate).total) / (2.0 * h * d);
                        assert!((f.by_depth / by_depth - 1.0).abs() < 1e-7);
                        let by_rate = (force(d, rate + h).total - force(d, rate - h).total) / (2.0 * h);
                        assert!((f.by_rate / by_rate - 1.0).abs() < 1e-7);
                    } else {
                        assert_eq!((f.by_depth, f.by_rate, f.elastic), (0.0, 0.0, k * d.powf(n)));
                    }
                }
            }
        }
    }

    #[test]
    fn restitution_follows_the_exact_relation() {
        let golden = golden();
        for (damping, e) in golden["HC_exact_e_vs_D"].as_object().unwrap() {
            let (damping, e): (f64, f64) = (damping.parse().unwrap(), e.as_f64().unwrap());
            assert!((restitution(damping) - e).abs() < 1e-13, "D = {damping}: {} for {e}", restitution(damping));
            assert!((dimensionless_damping(e).unwrap() / damping - 1.0).abs() < 1e-12);
        }
        for (e, damping) in golden["HC_exact_D_for_e"].as_object().unwrap() {
            let (e, damping): (f64, f64) = (e.parse().unwrap(), damping.as_f64().unwrap());
            assert!((dimensionless_damping(e).unwrap() / damping - 1.0).abs() < 1e-12, "e = {e}");
        }
        for (damping, e) in [(0.1, 0.937476), (0.5, 0.748435), (1.0, 0.593624), (2.0, 0.410720)] {
            assert!((restitution(damping) - e).abs() < 1e-6);
        }
    }

    #[test]
    fn approximate_laws_of_the_literature_have_the_restitution_they_are_known_for() {
        for (nominal, actual) in golden()["HC_models_actual_e_for_nominal"].as_object().unwrap() {
            let e: f64 = nominal.parse().unwrap();
            for (name, damping) in [
                ("HuntCrossley_1.5(1-e)", 1.5 * (1.0 - e)),
                ("LankaraniNikravesh_0.75(1-e^2)", 0.75 * (1.0 - e * e)),
                ("Flores_8(1-e)/(5e)", 1.6 * (1.0 - e) / e),
            ] {
                let actual = actual[name].as_f64().unwrap();
                assert!((restitution(damping) - actual).abs() < 1e-12, "{name} at {nominal}");
            }
        }
    }

    #[test]
    fn relation_and_inverse_agree_from_no_damping_to_the_least_restitution() {
        for i in 50..1000 {
            let e = f64::from(i) / 1e3;
            let back = restitution(dimensionless_damping(e).unwrap());
            assert!((back - e).abs() < 2e-14, "e = {e}: {back}");
        }
        for tiny in [1e-3, 1e-6, 1e-9, 1e-12] {
            let damping = dimensionless_damping(1.0 - tiny).unwrap();
            assert!(
                (damping - 1.5 * tiny * (1.0 + tiny)).abs() < 2.0 * tiny * tiny * tiny + 1e-15,
                "{tiny}: {damping}"
            );
        }
        assert_eq!((dimensionless_damping(1.0), restitution(0.0)), (Ok(0.0), 1.0));
        assert!((restitution(1e6) * 1e6 - 1.0).abs() < 1e-12 && restitution(f64::INFINITY) == 0.0);
    }

    #[test]
    fn restitutions_out_of_range_are_rejected_by_name() {
        for e in [-0.1, 0.0, 0.049, 1.001, f64::NAN, f64::INFINITY] {
            let problem = dimensionless_damping(e).unwrap_err();
            assert_eq!(problem.variable, "contact.restitution");
            assert!(problem.message.contains("0.05 to 1"));
        }
    }
}

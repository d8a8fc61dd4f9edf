//! Regression that shows if the host reacts: it explains the changes of u by the motion of the port.
//!
//! In a launch or a reversal, an inertia behind a spring accelerates with the port, and only the difference of both
//! motions changes u. Two high-pass filters therefore remove means and ramps from all values first. They act equally on
//! all values, so they keep the host's law.

use serde::{Deserialize, Serialize};

use crate::numeric::finite;

/// Fraction of the changes of u that the motion must explain if the host reacts.
pub const EXPLAINED: f64 = 0.5;
/// Fraction above which the host certainly reacts. If u is noise, the response of the unit to u explains one half.
pub const CERTAINLY_EXPLAINED: f64 = 0.8;
/// Fraction above which the law of the host is well known.
pub const WELL_EXPLAINED: f64 = 0.98;
/// Fraction above which a few steps of noise are excluded, too.
pub const WITHOUT_DOUBT_EXPLAINED: f64 = 0.95;
/// Weight of steps below which the regression shows nothing, because its coefficients need more data.
const LEAST_WEIGHT: f64 = 10.0;
/// Number of equal changes of u that the regression needs at least.
const LEAST_CHANGES: f64 = 2.0;
/// Changes below this fraction of the value are rounding errors of the host.
const ROUNDING: f64 = 1e-9;
/// Relative determinant below which both regressors are proportional.
const PROPORTIONAL: f64 = 1e-9;
/// Number of values of a step: Δu, x and y.
const VALUES: usize = 3;

/// Decaying sums of one port, over the changes Δu of the host's value, movements x and changes y of the rate of x.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Regression {
    /// Slow parts of the values, and of what remains of them, which the filters remove, with the sum of their weights.
    slow: [[f64; VALUES]; 2],
    slow_weight: f64,
    /// Sum of the weights of all steps.
    weight: f64,
    /// Means of the filtered Δu, x and y.
    means: [f64; VALUES],
    /// Sums of products of their deviations: uu, ux, uy, xx, xy, yy.
    products: [f64; 6],
    /// Sum of the fourth powers of the deviations of Δu.
    fourth: f64,
    /// Mean of |u|.
    magnitude: f64,
}

finite!(Regression { slow, slow_weight, weight, means, products, fourth, magnitude });

/// Law of a host that reacts: Δu = `per_movement` x + `per_rate` y.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Law {
    /// Change of u per movement of the port [N·m/rad, or rad/s per N·m·s].
    pub per_movement: f64,
    /// Change of u per change of the rate [N·m·s/rad, or rad/s per N·m].
    pub per_rate: f64,
}

finite!(Law { per_movement, per_rate });

impl Regression {
    /// Adds a step in which the host's value is `given`, with its [Δu, x, y]. Sums are multiplied by `decay`, and the
    /// slow parts by `slow_decay`.
    #[inline]
    pub fn add(&mut self, given: f64, mut values: [f64; VALUES], decay: f64, slow_decay: f64) {
        self.slow_weight = slow_decay * self.slow_weight + 1.0;
        for slow in &mut self.slow {
            for (value, slow) in values.iter_mut().zip(slow) {
                *slow += (*value - *slow) / self.slow_weight;
                *value -= *slow;
            }
        }
        self.weight = decay * self.weight + 1.0;
        let share = 1.0 / self.weight;
        let rest = 1.0 - share;
        self.magnitude += share * (given.abs() - self.magnitude);
        let [u, x, y]: [f64; VALUES] = std::array::from_fn(|i| values[i] - self.means[i]);
        self.means = [self.means[0] + share * u, self.means[1] + share * x, self.means[2] + share * y];
        let add = |sum: &mut f64, product: f64| *sum = decay * *sum + rest * product;
        let [uu, ux, uy, xx, xy, yy] = &mut self.products;
        add(xx, x * x);
        add(xy, x * y);
        add(yy, y * y);
        // sums of a constant u stay zero
        if u != 0.0 || *uu != 0.0 {
            add(uu, u * u);
            add(ux, u * x);
            add(uy, u * y);
            add(&mut self.fourth, u * u * u * u);
        }
    }

    /// Law of the host, if the motion explains at least the `fraction` of the changes of u.
    pub fn law(&self, fraction: f64) -> Option<Law> {
        let [uu, ux, uy, xx, xy, yy] = self.products;
        let rounding = ROUNDING * self.magnitude;
        // a few jumps of u prove no law, because any motion explains them
        let is_few = uu * uu < LEAST_CHANGES * self.fourth;
        if self.weight < LEAST_WEIGHT || uu <= self.weight * rounding * rounding || is_few {
            return None;
        }
        let determinant = xx * yy - xy * xy;
        let [per_movement, per_rate] = if determinant > PROPORTIONAL * xx * yy {
            [(ux * yy - uy * xy) / determinant, (uy * xx - ux * xy) / determinant]
        } else {
            // the two regressors are proportional, so one of them is enough
            let alone = |product: f64, square: f64| if square > 0.0 { product / square } else { 0.0 };
            let [by_movement, by_rate] = [alone(ux, xx), alone(uy, yy)];
            if by_movement * ux >= by_rate * uy { [by_movement, 0.0] } else { [0.0, by_rate] }
        };
        let explained = (per_movement * ux + per_rate * uy) / uu;
        (explained >= fraction).then_some(Law { per_movement, per_rate })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Regression over 400 steps of 1 ms. `changes(t, x, y)` is Δu at the time t [s], at which the rate of x is
    /// `rate(t)`.
    fn over(rate: impl Fn(f64) -> f64, changes: impl Fn(f64, f64, f64) -> f64) -> Regression {
        let (mut regression, h) = (Regression::default(), 1e-3);
        for step in 0..400 {
            let t = f64::from(step) * h;
            let (x, y) = (h * rate(t), rate(t + h) - rate(t));
            regression.add(1.0, [changes(t, x, y), x, y], 0.995, 0.95);
        }
        regression
    }

    #[test]
    fn a_spring_and_a_damper_react() {
        let reacts = |changes: fn(f64, f64, f64) -> f64| over(|t| (40.0 * t).sin(), changes).law(0.999).is_some();
        assert!(reacts(|_, x, _| 900.0 * x) && reacts(|_, _, y| 3.0 * y) && reacts(|_, x, y| 900.0 * x + 3.0 * y));
    }

    #[test]
    fn a_spring_to_an_inertia_that_accelerates_with_the_port_reacts() {
        // the port oscillates by 2 rad/s about the speed 50 rad/s² · t of the inertia
        let host = |t: f64, x: f64, _: f64| 900.0 * (x - 1e-3 * 50.0 * t);
        let launch = |sign: f64| {
            over(move |t| sign * (50.0 * t + 2.0 * (40.0 * t).sin()), move |t, x, y| sign * host(t, sign * x, y))
        };
        assert!(launch(1.0).law(CERTAINLY_EXPLAINED).is_some() && launch(-1.0).law(CERTAINLY_EXPLAINED).is_some());
    }

    #[test]
    fn values_of_another_frequency_and_straight_lines_do_not_react() {
        assert!(over(|t| (40.0 * t).sin(), |t, _, _| (93.0 * t).sin()).law(EXPLAINED).is_none());
        assert!(over(|t| 50.0 * t, |_, _, _| 1.0).law(EXPLAINED).is_none());
        assert!(over(|t| 50.0 * t, |t, _, _| (93.0 * t).sin()).law(EXPLAINED).is_none());
    }
}

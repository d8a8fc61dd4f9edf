//! Regression that shows if the host reacts: it explains the changes of u by the motion of the port.
//!
//! In a launch, an inertia behind a spring accelerates with the port, and only the difference of both motions changes u.
//! If u oscillates, a linear trend over the steps is therefore removed from all values.

use serde::{Deserialize, Serialize};

use crate::numeric::finite;

/// Fraction of the changes of u that the motion must explain if the host reacts.
pub const EXPLAINED: f64 = 0.5;
/// Fraction above which the host certainly reacts. If u is noise, the response of the unit to u explains one half.
pub const CERTAINLY_EXPLAINED: f64 = 0.8;
/// Weight of steps below which the regression shows nothing, because its coefficients need more data.
const LEAST_WEIGHT: f64 = 10.0;
/// Changes below this fraction of the value are rounding errors of the host.
const ROUNDING: f64 = 1e-9;
/// Relative determinant below which both regressors are proportional, and fraction of a sum below which only rounding
/// errors remain of it.
const PROPORTIONAL: f64 = 1e-9;
/// Movement of a step, relative to its usual magnitude, below which a port stands still.
const STILL: f64 = 1e-6;

/// Decaying sums of one port, over the changes Δu of the host's value, movements x and changes y of the rate of x.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Regression {
    /// Sum of the weights of all steps.
    weight: f64,
    /// Mean number of steps since the added ones. Unlike the time, it does not jump while the port stands still.
    age: f64,
    /// Means of Δu, x and y.
    means: [f64; 3],
    /// Sums of products of their deviations: uu, ux, uy, xx, xy, yy.
    products: [f64; 6],
    /// Sums of products of their deviations with that of the number of the step t: ut, xt, yt, tt.
    with_number: [f64; 4],
    /// Mean of |u|.
    magnitude: f64,
}

finite!(Regression { weight, age, means, products, with_number, magnitude });

impl Regression {
    /// Adds a step in which the host's value is `given`, with its [Δu, x, y]. Old terms are multiplied by `keep`.
    #[inline]
    pub fn add(&mut self, given: f64, values: [f64; 3], keep: f64) {
        self.weight = keep * self.weight + 1.0;
        let share = 1.0 / self.weight;
        let rest = 1.0 - share;
        self.magnitude += share * (given.abs() - self.magnitude);
        let [u, x, y]: [f64; 3] = std::array::from_fn(|i| values[i] - self.means[i]);
        self.means = [self.means[0] + share * u, self.means[1] + share * x, self.means[2] + share * y];
        let t = self.age + 1.0;
        self.age = rest * t;
        let add = |sum: &mut f64, product: f64| *sum = keep * *sum + rest * product;
        let [uu, ux, uy, xx, xy, yy] = &mut self.products;
        let [ut, xt, yt, tt] = &mut self.with_number;
        add(xx, x * x);
        add(xy, x * y);
        add(yy, y * y);
        add(xt, x * t);
        add(yt, y * t);
        add(tt, t * t);
        // sums of a constant u stay zero
        if u != 0.0 || *uu != 0.0 {
            add(uu, u * u);
            add(ux, u * x);
            add(uy, u * y);
            add(ut, u * t);
        }
    }

    /// True if the host reacts: the motion explains at least the `fraction` of the changes of u, as they are or, if u
    /// `oscillates`, without their trend. Before it oscillates, a jump of u would pass for an answer to the acceleration
    /// that it causes.
    pub fn reacts(&self, fraction: f64, oscillates: bool) -> bool {
        let rounding = ROUNDING * self.magnitude;
        let least = self.weight * rounding * rounding;
        let reacts = |products: [f64; 6]| products[0] > least && explained(products) >= fraction * products[0];
        self.weight >= LEAST_WEIGHT && (reacts(self.products) || oscillates && reacts(self.without_trend()))
    }

    /// Products after a linear trend over the steps has been removed.
    fn without_trend(&self) -> [f64; 6] {
        let ([uu, ux, uy, xx, xy, yy], [ut, xt, yt, tt]) = (self.products, self.with_number);
        let square = |all: f64, trend: f64| if all - trend > PROPORTIONAL * all { all - trend } else { 0.0 };
        [
            square(uu, ut * ut / tt),
            ux - ut * xt / tt,
            uy - ut * yt / tt,
            square(xx, xt * xt / tt),
            xy - xt * yt / tt,
            square(yy, yt * yt / tt),
        ]
    }

    /// True if a port that has `moved` in a step does not stand still.
    #[inline]
    pub fn is_motion(&self, moved: f64) -> bool {
        let usual =
            if self.weight > 0.0 { self.means[1] * self.means[1] + self.products[3] / self.weight } else { 0.0 };
        moved * moved > STILL * STILL * usual
    }
}

/// Part of uu that x and y explain.
fn explained([_, ux, uy, xx, xy, yy]: [f64; 6]) -> f64 {
    let determinant = xx * yy - xy * xy;
    if determinant > PROPORTIONAL * xx * yy {
        (ux * ux * yy - 2.0 * ux * uy * xy + uy * uy * xx) / determinant
    } else {
        let alone = |product: f64, square: f64| if square > 0.0 { product * product / square } else { 0.0 };
        alone(ux, xx).max(alone(uy, yy))
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
            regression.add(1.0, [changes(t, x, y), x, y], 0.995);
        }
        regression
    }

    #[test]
    fn a_spring_and_a_damper_react() {
        let reacts = |changes: fn(f64, f64, f64) -> f64| over(|t| (40.0 * t).sin(), changes).reacts(0.999, false);
        assert!(reacts(|_, x, _| 900.0 * x) && reacts(|_, _, y| 3.0 * y) && reacts(|_, x, y| 900.0 * x + 3.0 * y));
    }

    #[test]
    fn a_spring_to_an_inertia_that_accelerates_with_the_port_reacts() {
        // the port oscillates by 2 rad/s about the speed 50 rad/s² · t of the inertia
        let host = |t: f64, x: f64, _: f64| 900.0 * (x - 1e-3 * 50.0 * t);
        let launch = |sign: f64| {
            over(move |t| sign * (50.0 * t + 2.0 * (40.0 * t).sin()), move |t, x, y| sign * host(t, sign * x, y))
        };
        assert!(launch(1.0).reacts(CERTAINLY_EXPLAINED, true) && launch(-1.0).reacts(CERTAINLY_EXPLAINED, true));
        assert!(!launch(1.0).reacts(EXPLAINED, false));
    }

    #[test]
    fn values_of_another_frequency_and_straight_lines_do_not_react() {
        assert!(!over(|t| (40.0 * t).sin(), |t, _, _| (93.0 * t).sin()).reacts(EXPLAINED, true));
        assert!(!over(|t| 50.0 * t, |_, _, _| 1.0).reacts(EXPLAINED, true));
        assert!(!over(|t| 50.0 * t, |t, _, _| (93.0 * t).sin()).reacts(EXPLAINED, true));
    }
}

//! One port: energy error of a step, the sums of its errors, and the steps that they allow.

use std::f64::consts::SQRT_2;

use serde::{Deserialize, Serialize};

use super::memory::{LEAST_STEPS, Oscillation};
use super::regression::{EXPLAINED, Law, Regression, WELL_EXPLAINED};
use super::swing::Swing;
use crate::numeric::{finite, pow, quotient, sqrt};

/// Magnitude up to which values count. Larger ones belong to a motion that has diverged.
const LARGEST: f64 = 1e12;
/// Ratio of the time over which sums decay to that of the filters of the regression, and least number of their steps.
const FILTER: f64 = 8.0;
const LEAST_FILTER_STEPS: f64 = 10.0;
/// Rate of the port, relative to the fastest one before, below which it stands still.
const STILL: f64 = 1e-4;
/// Number of steps of Newton's method.
const NEWTON_STEPS: u32 = 6;
/// Number of successive still steps after which the port does not move.
const STILL_STEPS: u32 = 5;

/// Exchange of one port over one communication step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PortStep {
    /// Value u that the host has set for the start of the step [N·m or rad/s].
    pub given: f64,
    /// Mean ū of the input over the step [N·m or rad/s].
    pub mean: f64,
    /// Movement x of the port over the step: its angle, or its angular impulse [rad or N·m·s].
    pub moved: f64,
    /// Change of the rate of x over the step [rad/s or N·m].
    pub changed: f64,
    /// Length of the step [s]; 0 if the host sets no value here.
    pub h: f64,
    /// True if the input follows derivatives that the host has set.
    pub is_line: bool,
}

finite!(PortStep { given, mean, moved, changed, h; is_line });

impl PortStep {
    /// True if the step belongs to a motion that has not diverged.
    pub fn is_moderate(&self) -> bool {
        self.given.abs() + self.mean.abs() + self.moved.abs() + self.changed.abs() < LARGEST
    }

    /// Energy that passed [J].
    pub fn passed(&self) -> f64 {
        self.mean * self.moved
    }
}

/// Number of later steps that the result of a step needs.
pub const LAG: usize = 2;

/// Energy that a host with `delay` would exchange minus the energy of the unit, over the second of four `steps` [J].
/// `has_earlier` is false if the first step is missing.
///
/// For lines, the host's curve is a cubic, because the error of a line is of the order of its curvature.
#[inline]
pub fn energy_difference(steps: [&PortStep; 4], delay: f64, has_earlier: bool) -> f64 {
    let [before, here, next, after] = steps;
    let ahead = delay + 0.5;
    let first = next.given - here.given;
    let mut mean = if ahead <= 1.0 { ahead * first } else { first + (ahead - 1.0) * (after.given - next.given) };
    mean += here.given - here.mean;
    if here.is_line {
        let second = after.given - next.given;
        let is_centred = has_earlier && delay <= 0.5;
        let curvature = if is_centred { 0.5 * (second - (here.given - before.given)) } else { second - first };
        mean -= curvature / 12.0;
        // both values change at different rates while the rate of x changes
        let change = 2.0 * (here.mean - here.given);
        return mean * here.moved + (answer(steps, delay) - change) * here.changed * here.h / 12.0;
    }
    mean * here.moved
}

/// Change of u that belongs to the second of four `steps`, for a host with `delay`.
#[inline]
fn answer(steps: [&PortStep; 4], delay: f64) -> f64 {
    let [before, here, next, after] = steps.map(|step| step.given);
    if delay < 0.0 {
        (1.0 + delay) * (next - here) - delay * (here - before)
    } else {
        (1.0 - delay) * (next - here) + delay * (after - next)
    }
}

/// Half-shaft of a side driven by speed, which turns the movement of the port into its torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaft {
    /// Stiffness [N·m/rad].
    pub stiffness: f64,
    /// Damping [N·m·s/rad].
    pub damping: f64,
}

/// Sums of one port.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Port {
    /// Energy that the cut has created since the start [J].
    pub error: f64,
    /// Decaying sum of the energy that passed [J].
    pub passed: f64,
    /// Decaying sum of the magnitudes of the energy errors [J].
    pub errors: f64,
    /// Decaying sum of the magnitudes of the energy errors of order 1, each divided by its step [J/s].
    first_order: f64,
    /// Decaying sum of the magnitudes of the energy errors of order 2, each divided by the square of its step [J/s²].
    second_order: f64,
    /// Number of successive steps in which the port stood still.
    still: u32,
    /// Largest magnitude of the rate at which the port has moved.
    fastest: f64,
    /// True if the host's values followed a line in the last step.
    is_line: bool,
    /// Reaction of the host.
    regression: Regression,
    /// Last law of the host that explained nearly all changes of u. A motion that has decayed does not show the law.
    known: Option<Law>,
    /// Oscillation of u.
    pub oscillation: Oscillation,
    /// Swings of the torque.
    swing: Swing,
}

finite!(Port { error, passed, errors, first_order, second_order, fastest, regression, known, oscillation, swing; still, is_line });

impl Port {
    /// Adds the second of four `steps` of a host with `delay`, whose values act `lag` steps late. Its energy error is
    /// `error` [J]. Its torque is the rate of the movement if the port `is_shaft`, or else the host's value. Old errors are
    /// multiplied by `decay`.
    #[inline]
    pub fn add(&mut self, steps: [&PortStep; 4], (error, is_shaft): (f64, bool), [delay, lag]: [f64; 2], decay: f64) {
        let PortStep { given, moved, changed, h, is_line, .. } = *steps[1];
        self.error += error;
        self.passed = decay * self.passed + steps[1].passed().abs();
        self.errors = decay * self.errors + error.abs();
        self.first_order *= decay;
        self.second_order *= decay;
        if is_line && delay == 0.0 {
            self.second_order += error.abs() / (h * h);
        } else {
            self.first_order += error.abs() / h;
        }
        // a standstill shows nothing, however long it lasts
        self.fastest = self.fastest.max((moved / h).abs());
        if moved.abs() <= STILL * self.fastest * h {
            self.still = self.still.saturating_add(1);
            return;
        }
        self.still = 0;
        // the reaction shows in the motion of this port, however slow other motions are
        let memory = self.oscillation.memory().max(LEAST_STEPS * h);
        let filter = (memory / FILTER).max(LEAST_FILTER_STEPS * h);
        let values = [answer(steps, delay), moved, changed];
        self.regression.add(given, values, memory / (memory + h), filter / (filter + h));
        self.known = self.regression.law(WELL_EXPLAINED).or(self.known);
        self.oscillation.add(given, h);
        self.swing.add(if is_shaft { moved / h } else { given }, h, (lag, is_line));
        self.is_line = is_line;
    }

    /// True if the port moves. At the turning point of an oscillation, it stands still for a single step.
    pub fn moves(&self) -> bool {
        self.still < STILL_STEPS
    }

    /// True if the host reacts: the motion explains at least the `fraction` of the changes of u.
    pub fn reacts(&self, fraction: f64) -> bool {
        self.regression.law(fraction).is_some()
    }

    /// Number of successive swings of the torque that have grown.
    pub fn growths(&self) -> u32 {
        self.swing.growths
    }

    /// Magnitude of the energy errors divided by the energy that passed, which is at least `least` [J].
    pub fn ratio(&self, least: f64) -> f64 {
        let passed = self.passed.max(least);
        if passed > 0.0 { self.errors / passed } else { 0.0 }
    }

    /// Communication step at which the ratio would be `wanted` [s]: the positive root of A h + B h² = `wanted` · W. It
    /// is infinite without an error.
    pub fn step_of_ratio(&self, wanted: f64, least: f64) -> f64 {
        let (a, b, c) = (self.first_order, self.second_order, wanted * self.passed.max(least));
        if a + b > 0.0 { 2.0 * c / (a + sqrt(a * a + 4.0 * b * c)) } else { f64::INFINITY }
    }

    /// Law of a host that reacts or has reacted. `sign` is 1 for a load and −1 for a drive.
    pub fn law(&self, sign: f64) -> Option<Law> {
        let law = self.known.or_else(|| self.regression.law(EXPLAINED))?;
        Some(Law { per_movement: sign * law.per_movement, per_rate: sign * law.per_rate })
    }

    /// Longest stable step [s] of a host that sets a torque, which acts `lag` steps late. Its springs give the unit the
    /// `rates` ω² [1/s²], and its dampers the rate λ [1/s]. It is infinite if the cut shows no limit.
    ///
    /// A spring with a damper acts the time τ = λ/ω² ahead. With a = (ω h)²/2 and b = λ h, held inputs are stable if
    /// (1 + 2 `lag`) a + `lag` b² < b, a lower bound that is exact without lag, and if (1 + `lag`) b < 2. The line
    /// through two values is a two-step Adams-Bashforth method: see [`line_limit`] for springs; dampers are stable up
    /// to λ h = 1, or 2 (√2 − 1) if the values are one step old.
    pub fn stable_step_of_torque(&self, lag: f64, [spring, damper]: [f64; 2]) -> f64 {
        let quotient = |a, b| quotient(a, b).unwrap_or(f64::INFINITY);
        let late = lag.max(0.0);
        if self.is_line {
            let damped = quotient(1.0, (1.0 + late * (0.5 * SQRT_2 - 0.5)) * damper);
            limit(line_limit(quotient(damper, spring), sqrt(spring), late)).min(limit(damped))
        } else {
            let sprung = quotient(damper, (0.5 + lag) * spring + late * damper * damper);
            limit(sprung).min(limit(quotient(2.0, (1.0 + lag) * damper)))
        }
    }

    /// Longest stable step [s] of a host that sets the speed behind the unit's `shaft` k, c, which acts `lag` steps
    /// late. The host has this `law`. The step is infinite if the cut shows no limit.
    ///
    /// The host's inertia with the mobility b and the half-shaft make an oscillation with ω² = k b, whose damping acts
    /// the time τ = c/k + d_u/b ahead. Held inputs are stable up to (½ + `lag`) h = τ and up to ω h = 2.
    pub fn stable_step_of_speed(&self, lag: f64, shaft: Shaft, law: &Law) -> f64 {
        let Law { per_movement, per_rate, .. } = *law;
        if per_movement <= 0.0 {
            return f64::INFINITY;
        }
        let ahead = shaft.damping / shaft.stiffness + per_rate.max(0.0) / per_movement;
        let rate = sqrt(shaft.stiffness * per_movement);
        if self.is_line {
            limit(line_limit(ahead, rate, lag.max(0.0)))
        } else {
            limit(quotient(ahead, 0.5 + lag).unwrap_or(f64::INFINITY).min(2.0 / rate))
        }
    }
}

/// Longest stable step [s] of a two-step Adams-Bashforth method on an oscillation with the `rate` ω [1/s] and damping
/// that acts the time τ `ahead` [s], if its values are `late` steps old. The factor 1 + `late` (ω h)²/2 + (ω h)⁴/4 in a
/// step must not exceed the damping 1 + τ ω² h/2. Newton's method finds the step from above.
fn line_limit(ahead: f64, rate: f64, late: f64) -> f64 {
    if rate <= 0.0 || !ahead.is_finite() {
        return f64::INFINITY;
    }
    let square = rate * rate;
    let mut step = pow(2.0 * ahead * rate, 1.0 / 3.0) / rate;
    for _ in 0..NEWTON_STEPS {
        let slope = late + 1.5 * square * step * step;
        if slope > 0.0 {
            step -= (late * step + 0.5 * square * step * step * step - ahead) / slope;
        }
    }
    step
}

/// Returns a limit. Without any damping, no step is stable; a growing swing then reports the unstable cut.
fn limit(step: f64) -> f64 {
    if step > 0.0 { step } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn difference(given: [f64; 4], mean: f64, (moved, is_line): (f64, bool), delay: f64) -> f64 {
        let steps = given.map(|given| PortStep { given, mean, moved, changed: 0.0, h: 1.0, is_line });
        energy_difference(steps.each_ref(), delay, true)
    }

    #[test]
    fn held_torques_give_the_means_of_the_ends_and_of_later_steps() {
        let (u, x) = ([3.0, 5.0, 9.0, 17.0], 0.25);
        let difference = |delay: f64| difference(u, u[1], (x, false), delay);
        // without delay, the mean of both ends; one step later, the mean of the next two values
        assert_eq!(difference(0.0), (0.5 * (5.0 + 9.0) - 5.0) * x);
        assert_eq!(difference(1.0), (0.5 * (9.0 + 17.0) - 5.0) * x);
        // a spring behind a Jacobi master, and behind a Gauss-Seidel master
        assert_eq!(difference(0.5), (9.0 - 5.0) * x);
        assert_eq!(difference(-0.5), 0.0);
    }

    #[test]
    fn lines_through_the_last_two_torques_have_the_error_of_a_parabola() {
        // u = t² and steps of 1: ∫ (u − line) dt = ∫ (t² − 4 − 3 (t − 2)) dt from 2 to 3
        let line_mean = 4.0 + 0.5 * 3.0;
        let exact = 19.0 / 3.0 - line_mean;
        let found = difference([1.0, 4.0, 9.0, 16.0], line_mean, (1.0, true), 0.0);
        assert!((found - exact).abs() < 1e-14, "{found} {exact}");
    }

    /// A spring k with a damper c at an inertia J, held without delay: 2 c/k; a damper: 2 J/c, and one step later J/c;
    /// on lines, J/c.
    #[test]
    fn stable_steps_of_torques_have_their_closed_forms() {
        let (k, c, j) = (9000.0, 12.0, 5.0);
        let of = |is_line: bool, delay: f64, rates: [f64; 2]| {
            Port { is_line, ..Port::default() }.stable_step_of_torque(delay, rates)
        };
        let close = |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
        close(of(false, 0.0, [k / j, c / j]), 2.0 * c / k);
        close(of(false, 0.0, [0.0, c / j]), 2.0 * j / c);
        close(of(false, 1.0, [0.0, c / j]), j / c);
        // Jury's criterion for one step of delay: b - 3 a = (b - a)²
        for c in [3.0, 12.0, 60.0] {
            let h = of(false, 1.0, [k / j, c / j]);
            let [a, b] = [0.5 * h * h * k / j, h * c / j];
            let excess = b - 3.0 * a - (b - a) * (b - a);
            assert!((0.0..0.2 * b).contains(&excess), "{c}: {excess} {b}");
        }
        close(of(true, 0.0, [0.0, c / j]), j / c);
        close(of(true, 1.0, [0.0, c / j]), 2.0 * (SQRT_2 - 1.0) * j / c);
        // 1 + (ω h)⁴/4 = 1 + τ ω² h/2
        let (rate, ahead) = (sqrt(k / j), c / k);
        let h = of(true, 0.0, [k / j, c / j]);
        close((rate * h).powi(4) / 4.0, ahead * rate * rate * h / 2.0);
        // values that are one step old act as late as a damper of k h
        let late = of(true, 1.0, [k / j, c / j]);
        close(rate * rate * late * late / 2.0 + (rate * late).powi(4) / 4.0, ahead * rate * rate * late / 2.0);
        assert_eq!(of(false, 0.0, [0.0; 2]), f64::INFINITY);
    }
}

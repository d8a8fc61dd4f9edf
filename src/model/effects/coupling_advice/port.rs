//! One port: energy error of a step, and the sums of its errors.

use serde::{Deserialize, Serialize};

use super::memory::{LEAST_STEPS, Oscillation};
use super::regression::Regression;
use crate::numeric::finite;

/// Magnitude up to which values count. Larger ones belong to a motion that has diverged.
const LARGEST: f64 = 1e12;
/// Growth of the energy error from half-period to half-period that counts as growth.
const GROWS: f64 = 1.02;

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

/// Sums of one port.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Port {
    /// Energy that the cut has created since the start [J].
    pub error: f64,
    /// Decaying sum of the magnitudes of the energy errors [J].
    pub errors: f64,
    /// True if the port moved in the last step that was added.
    pub moves: bool,
    /// Reaction of the host.
    pub regression: Regression,
    /// Oscillation of u.
    pub oscillation: Oscillation,
    /// Magnitude and sum of the energy errors since u last changed sides, and the magnitude before [J].
    half_period: [f64; 3],
    /// Number of successive half-periods in which the created energy has grown.
    pub growths: u32,
}

finite!(Port { error, errors, regression, oscillation, half_period; growths, moves });

impl Port {
    /// Adds the second of four `steps` with the energy `error` [J]. Old errors are multiplied by `keep`.
    #[inline]
    pub fn add(&mut self, steps: [&PortStep; 4], error: f64, delay: f64, keep: f64) {
        let PortStep { given, moved, changed, h, .. } = *steps[1];
        self.error += error;
        self.errors = keep * self.errors + error.abs();
        // a standstill shows nothing, however long it lasts
        self.moves = self.regression.is_motion(moved);
        if !self.moves {
            return;
        }
        // the reaction shows in the motion of this port, however slow other motions are
        let memory = self.oscillation.memory().max(LEAST_STEPS * h);
        self.regression.add(given, [answer(steps, delay), moved, changed], memory / (memory + h));
        self.half_period[0] += error.abs();
        self.half_period[1] += error;
        if self.oscillation.add(given, h) {
            let [magnitude, sum, before] = self.half_period;
            let grows = sum > 0.0 && before > 0.0 && magnitude > GROWS * before;
            self.growths = if grows { self.growths.saturating_add(1) } else { 0 };
            self.half_period = [0.0, 0.0, magnitude];
        }
    }

    /// True if the host reacts: the motion explains at least the `fraction` of the changes of u.
    pub fn reacts(&self, fraction: f64) -> bool {
        self.regression.reacts(fraction, self.oscillation.has_period())
    }
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
}

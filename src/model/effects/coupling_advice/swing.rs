//! Growth of the torque at a port, from one turning point to the next.

use serde::{Deserialize, Serialize};

use crate::numeric::{PI, TAU, finite};

/// Fraction of the last swing by which a torque must return before its extreme counts as a turning point.
const RETURN: f64 = 0.25;
/// Swings below this fraction of the torque are rounding errors.
const ROUNDING: f64 = 1e-9;
/// Growth per period that counts as growth.
const GROWS: f64 = 1.01;
/// Ratio of the observed growth to the largest growth that the cut can cause, above which the cut is not its cause.
const MARGIN: f64 = 1.3;
/// Number of steps in a period below which communication points do not resolve the oscillation.
const UNRESOLVED: f64 = 4.5;

/// Swings of one torque between its turning points. Both directions are treated identically, and slow changes of the
/// mean have no influence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Swing {
    /// Direction of the present swing: −1, 1, or 0 before the first change.
    direction: f64,
    /// Torque at the last turning point, and the extreme since then [N·m].
    turn: f64,
    extreme: f64,
    /// Time from the last turning point to the present, and to the extreme [s].
    since: f64,
    to_extreme: f64,
    /// Sizes of the last two swings [N·m], and duration of the last one [s].
    sizes: [f64; 2],
    duration: f64,
    /// Number of successive swings that were larger than the swing one period before, by no more than the cut can cause.
    pub growths: u32,
}

finite!(Swing { direction, turn, extreme, since, to_extreme, sizes, duration; growths });

impl Swing {
    /// Adds the `torque` [N·m] of a step of length `h` [s], of a host with `delay`, whose inputs are lines or held.
    #[inline]
    pub fn add(&mut self, torque: f64, h: f64, (delay, is_line): (f64, bool)) {
        self.since += h;
        let change = torque - self.extreme;
        if change * self.direction > 0.0 || self.direction == 0.0 {
            if self.direction == 0.0 && self.since > h && change != 0.0 {
                self.direction = change.signum();
            }
            (self.extreme, self.to_extreme) = (torque, self.since);
            if self.direction == 0.0 {
                self.turn = torque;
            }
            return;
        }
        let size = (self.extreme - self.turn).abs();
        let least = ROUNDING * (self.turn.abs() + self.extreme.abs());
        if change.abs() <= least.max(RETURN * size) {
            return;
        }
        let period = self.duration + self.to_extreme;
        let growth = if self.sizes[0] > 0.0 { size / self.sizes[0] } else { 0.0 };
        let grows = growth > GROWS && growth <= largest_growth(period / h, delay, is_line);
        self.growths = if grows { self.growths.saturating_add(1) } else { 0 };
        self.sizes = [self.sizes[1], size];
        self.duration = self.to_extreme;
        self.since -= self.to_extreme;
        (self.turn, self.extreme, self.to_extreme) = (self.extreme, torque, self.since);
        self.direction = -self.direction;
    }
}

/// Largest growth in a period of `steps` steps that a cut to a host with `delay` can cause.
///
/// An oscillation with the rate ω exchanges the energy û x̂/2 with a spring or an inertia. Held inputs act (½ + `delay`)
/// steps of length h late, so they create the energy π ω h (½ + `delay`) û x̂ in a period, and the amplitude grows by the
/// factor exp(π ω h (½ + `delay`)). For lines, the phase error is of the order (ω h)². A motion that communication points do not
/// resolve can grow without limit.
fn largest_growth(steps: f64, delay: f64, is_line: bool) -> f64 {
    if steps <= UNRESOLVED {
        return f64::INFINITY;
    }
    let phase = TAU / steps;
    let exponent = MARGIN * PI * if is_line { phase * phase } else { phase * (0.5 + delay) };
    // lower bound of the exponential function
    1.0 + exponent + 0.5 * exponent * exponent
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Swings of 20 periods of 40 steps, whose amplitude grows by the factor `growth` in a period, on a torque that rises.
    fn after(growth: f64, (delay, is_line): (f64, bool), sign: f64) -> u32 {
        let mut swing = Swing::default();
        for step in 0..800 {
            let periods = f64::from(step) / 40.0;
            let torque = 3.0 * periods + 20.0 * growth.powf(periods) * (TAU * periods).sin();
            swing.add(sign * torque, 1e-3, (delay, is_line));
        }
        swing.growths
    }

    #[test]
    fn growth_that_the_cut_can_cause_is_counted_in_each_half_period() {
        // exp(π ω h/2) = 1.28 in a period of 40 steps without delay
        for sign in [1.0, -1.0] {
            assert!(after(1.05, (0.0, false), sign) > 30);
            assert!(after(1.2, (0.0, false), sign) > 30);
            assert_eq!(after(0.99, (0.0, false), sign), 0);
        }
    }

    #[test]
    fn growth_that_is_faster_than_the_cut_can_cause_has_another_reason() {
        assert_eq!(after(1.5, (0.0, false), 1.0), 0);
        assert!(after(1.5, (1.0, false), 1.0) > 30);
        assert_eq!(after(1.2, (0.0, true), 1.0), 0);
        // Gauss-Seidel exchanges the right energy
        assert_eq!(after(1.2, (-0.5, false), 1.0), 0);
    }

    #[test]
    fn a_motion_of_two_steps_that_grows_is_not_resolved() {
        let mut swing = Swing::default();
        for step in 0..40 {
            swing.add(if step % 2 == 0 { 1.0 } else { -1.0 } * 1.1f64.powi(step), 1e-3, (-0.5, false));
        }
        assert!(swing.growths > 30);
    }
}

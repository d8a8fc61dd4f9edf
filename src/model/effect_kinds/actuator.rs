//! Actuator of a command: what follows the command u is the output y of
//!
//! ```text
//! g = max(0, (u − u₀)/(1 − u₀))              dead band u₀
//! r follows g, |ṙ| ≤ 1/T                     limit of the rate; T is the time of a full stroke
//! τ² ÿ + 2 ζ τ ẏ + y = r                     filter of second order
//! ```
//!
//! and acts as max(y, 0). Commands are parabolas of time within a step, so r consists of parabolas, under which the
//! filter has a closed form: y is exact at any time. τ = 0 leaves dead band and rate, T = 0 leaves no limit of the rate.

use libm::exp;
use serde::{Deserialize, Serialize};

use crate::declaration::Group;
use crate::declaration::prelude::*;
use crate::numeric::{cos, finite, quadratic_roots, sin, sqrt};

/// Distance from its target at which an actuator counts as settled, relative to the full command.
const SETTLED: f64 = 1e-9;
/// Difference below which the limited command counts as equal to its target.
const EQUAL: f64 = 1e-12;
/// Largest number of pieces within a step: a parabola enters and leaves dead band, limits and rate limit twice each.
const MOST_PIECES: usize = 24;
/// Time below which a time of an actuator counts as 0 [s].
const SHORTEST: f64 = 1e-6;
/// Shortest time after which a lock follows its actuator [s].
const SHORTEST_FOLLOWING: f64 = 1e-5;
/// Argument below which the hyperbolic functions of an overdamped filter follow from those without cancellation.
const NEARLY_CRITICAL: f64 = 1e-3;

/// Group of parameters of an effect whose command passes an actuator.
pub trait Actuates: Group {
    /// The parameters of the actuator.
    fn actuator(&mut self) -> &mut Actuator;
}

parameters! {
    /// Actuator between a command and its effect.
    pub struct Actuator of Owner: Actuates, by actuator {
        /// Command up to which nothing moves
        dead_band: f64 = 0.0, ONE, 0.0..=0.99;
        /// Shortest time from no command to full command, which limits the rate; below 1 us = no limit
        stroke_time: f64 = 0.0, SECOND, 0.0..=100.0;
        /// Time constant of the response; below 1 us = immediate
        response_time: f64 = 0.0, SECOND, 0.0..=100.0;
        /// Damping ratio of the response
        response_damping: f64 = 1.0, ONE, 0.1..=10.0, when(test!(
            Owner, "response_time", ">", |owner| { *owner }.actuator().response_time > 0.0, [0.0]
        ));
    }
}

/// State of an actuator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ActuatorState {
    /// Command r after dead band and limit of the rate.
    pub limited: f64,
    /// Output y.
    pub value: f64,
    /// Its rate ẏ [1/s].
    pub rate: f64,
}

finite!(ActuatorState { limited, value, rate });

/// Value that changes along a parabola: value, first and second derivative at its start [1, 1/s, 1/s²].
pub type Parabola = [f64; 3];

/// Part of a motion during which r is a parabola.
struct Piece {
    /// Course of r.
    limited: Parabola,
    /// Time until it ends [s].
    length: f64,
    /// True if r has the value of the target at its end.
    follows: bool,
    /// Value of the command at its end, if it reaches a limit or the dead band there.
    reaches: Option<f64>,
}

impl Actuator {
    /// The actuator without times that are too short to have an effect.
    pub fn effective(mut self) -> Self {
        for time in [&mut self.stroke_time, &mut self.response_time] {
            *time = if *time < SHORTEST { 0.0 } else { *time };
        }
        self
    }

    /// True if the output is always the command.
    pub fn is_direct(&self) -> bool {
        self.is_immediate() && self.dead_band == 0.0
    }

    /// True if the output follows the command without delay.
    pub fn is_immediate(&self) -> bool {
        self.response_time == 0.0 && self.stroke_time == 0.0
    }

    /// Time in which the output changes by about one hundredth of the full command at its highest rate [s].
    pub fn hundredth(&self) -> f64 {
        (0.01 * self.stroke_time.max(2.0 * self.response_time)).max(SHORTEST_FOLLOWING)
    }

    /// State that has settled at the `command`.
    pub fn settled(&self, command: f64) -> ActuatorState {
        let value = self.target(&[command, 0.0, 0.0])[0];
        ActuatorState { limited: value, value, rate: 0.0 }
    }

    /// True if the output stays constant under the `command`.
    pub fn is_settled(&self, state: &ActuatorState, command: &Parabola) -> bool {
        let [target, first, second] = self.target(command);
        let near = |difference: f64| difference.abs() <= SETTLED;
        [first, second] == [0.0; 2]
            && (self.is_immediate()
                || state.limited == target && near(state.value - target) && near(self.response_time * state.rate))
    }

    /// Target g of the output with its derivatives.
    fn target(&self, command: &Parabola) -> Parabola {
        let (beyond, first) = (command[0] - self.dead_band, command[1]);
        let rises = beyond > 0.0 || beyond == 0.0 && (first > 0.0 || first == 0.0 && command[2] > 0.0);
        if rises { [beyond, first, command[2]].map(|of| of / (1.0 - self.dead_band)) } else { [0.0; 3] }
    }

    /// Change of the output per change of the `command`.
    pub fn feedthrough(&self, command: f64) -> f64 {
        if self.is_immediate() && command >= self.dead_band { 1.0 / (1.0 - self.dead_band) } else { 0.0 }
    }

    /// What acts, max(y, 0), with its derivatives, now and from now on under the `command`.
    pub fn acting(&self, state: &ActuatorState, command: &Parabola) -> Parabola {
        let command = &within_limits(command);
        let limited = self.piece(state.limited, command, self.follows(state, command)).limited;
        let (time, value) = (self.response_time, if self.response_time == 0.0 { limited[0] } else { state.value });
        let of_filter = || {
            let force = limited[0] - value - 2.0 * self.response_damping * time * state.rate;
            [value, state.rate, force / (time * time)]
        };
        let all = if time == 0.0 { limited } else { of_filter() };
        let rests = value < 0.0 || value == 0.0 && (all[1] < 0.0 || all[1] == 0.0 && all[2] <= 0.0);
        if rests { [0.0; 3] } else { all }
    }

    /// State after `time` [s] under the `command`.
    pub fn after(&self, state: &ActuatorState, command: &Parabola, time: f64) -> ActuatorState {
        let (mut state, mut command, mut left) = (*state, *command, time);
        let mut follows = self.follows(&state, &command);
        for k in 1..=MOST_PIECES {
            command = within_limits(&command);
            let piece = self.piece(state.limited, &command, follows);
            let is_last = piece.length >= left || k == MOST_PIECES;
            let length = if is_last { left } else { piece.length };
            state = self.filtered(&state, &piece.limited, length);
            command = moved(&command, length);
            if is_last {
                break;
            }
            left -= length;
            follows = piece.follows;
            command[0] = piece.reaches.unwrap_or(command[0]);
        }
        if self.is_settled(&state, &within_limits(&command)) { self.settled(command[0].clamp(0.0, 1.0)) } else { state }
    }

    /// True if the limited command is on its target.
    fn follows(&self, state: &ActuatorState, command: &Parabola) -> bool {
        self.stroke_time == 0.0 || (state.limited - self.target(command)[0]).abs() <= EQUAL
    }

    /// First piece of the motion of r from `limited` on, under the `command`. `follows` says if r is on its target.
    fn piece(&self, limited: f64, command: &Parabola, follows: bool) -> Piece {
        let target = self.target(command);
        let (mut length, mut reaches) = (f64::INFINITY, None);
        for level in [0.0, self.dead_band, 1.0] {
            if let Some(time) = first_zero(&[command[0] - level, command[1], command[2]]).filter(|&time| time < length)
            {
                (length, reaches) = (time, Some(level));
            }
        }
        if self.stroke_time == 0.0 {
            return Piece { limited: target, length, follows: true, reaches };
        }
        let most = 1.0 / self.stroke_time;
        let excess = target[1].abs() - most;
        if follows && (excess < 0.0 || excess == 0.0 && target[2] * target[1] <= 0.0) {
            let turn = (most.copysign(target[2]) - target[1]) / target[2];
            let (length, reaches) = if target[2] != 0.0 && turn < length { (turn, None) } else { (length, reaches) };
            return Piece { limited: target, length, follows: true, reaches };
        }
        let direction = if follows { target[1] } else { target[0] - limited };
        let rate = most.copysign(direction);
        let gap = if follows { 0.0 } else { target[0] - limited };
        match first_zero(&[gap, target[1] - rate, target[2]]).filter(|&time| time <= length) {
            Some(met) => {
                let reaches = reaches.filter(|_| met == length);
                Piece { limited: [limited, rate, 0.0], length: met, follows: true, reaches }
            }
            None => Piece { limited: [limited, rate, 0.0], length, follows: false, reaches },
        }
    }

    /// State after `time` [s] while r follows the parabola `limited`.
    fn filtered(&self, state: &ActuatorState, limited: &Parabola, time: f64) -> ActuatorState {
        let [end, slope, _] = moved(limited, time);
        let (tau, damping) = (self.response_time, self.response_damping);
        if tau == 0.0 {
            return ActuatorState { limited: end, value: end, rate: slope };
        }
        // particular solution: a parabola
        let lag = 2.0 * damping * tau;
        let first = limited[1] - lag * limited[2];
        let particular = [limited[0] - lag * first - tau * tau * limited[2], first, limited[2]];
        let [value, rate, _] = moved(&particular, time);
        let deviation = free(damping, [state.value - particular[0], tau * (state.rate - first)], time / tau);
        ActuatorState { limited: end, value: value + deviation[0], rate: rate + deviation[1] / tau }
    }
}

/// Solution of x″ + 2 ζ x′ + x = 0 at `s` from x and x′ at 0: exp(A s) with A + ζ I of square (ζ² − 1) I.
fn free(damping: f64, [x, slope]: [f64; 2], s: f64) -> [f64; 2] {
    let square = damping * damping - 1.0;
    let root = sqrt(square.abs());
    let phase = root * s;
    // e^(−ζ s) times cosine and sine over the root, which become hyperbolic with ζ > 1
    let [c, sine] = if square > 0.0 && phase > NEARLY_CRITICAL {
        // the slow root −1/(ζ + root) without cancellation
        let [slow, fast] = [exp(-s / (damping + root)), exp(-(damping + root) * s)];
        [0.5 * (slow + fast), 0.5 * (slow - fast) / root]
    } else {
        let decay = exp(-damping * s);
        // terms of the series up to the fourth power suffice below the limit
        let z = square * s * s;
        let near = [1.0 + z * (0.5 + z / 24.0), s * (1.0 + z * (1.0 / 6.0 + z / 120.0))];
        let [c, sine] = if phase > NEARLY_CRITICAL { [cos(phase), sin(phase) / root] } else { near };
        [decay * c, decay * sine]
    };
    [c * x + sine * (damping * x + slope), c * slope - sine * (x + damping * slope)]
}

/// Parabola `time` [s] later.
pub fn moved(of: &Parabola, time: f64) -> Parabola {
    [of[0] + time * (of[1] + 0.5 * time * of[2]), of[1] + time * of[2], of[2]]
}

/// Command that stays at 0 or 1 once it would leave this range.
fn within_limits(command: &Parabola) -> Parabola {
    let [value, first, second] = *command;
    let leaves = |outwards: f64| {
        let [first, second] = [outwards * first, outwards * second];
        first > 0.0 || first == 0.0 && second > 0.0
    };
    if value >= 1.0 && leaves(1.0) || value > 1.0 {
        [1.0, 0.0, 0.0]
    } else if value <= 0.0 && leaves(-1.0) || value < 0.0 {
        [0.0; 3]
    } else {
        *command
    }
}

/// First time after now at which the parabola is 0 [s]; now does not count.
fn first_zero(&[value, first, second]: &Parabola) -> Option<f64> {
    quadratic_roots([value, first, 0.5 * second]).into_iter().filter(|&time| time > 0.0).reduce(f64::min)
}

#[cfg(test)]
#[path = "tests/actuator.rs"]
mod tests;

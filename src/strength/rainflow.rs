//! Rainflow counting of a load history as it comes, ASTM E1049-85 (2017), section 5.4.4.
//!
//! For teeth that stay in mesh while the gears do not roll. Peaks and valleys wait on a stack of fixed size; ranges on it
//! decrease from the bottom to the top, so that only a decaying oscillation fills it. Then the smallest range is
//! counted at once, as a full cycle, which it becomes if the load grows beyond it again and which is conservative if
//! not; nothing is lost and larger ranges stay as they are.

use serde::{Deserialize, Serialize};

use crate::numeric::finite;

/// Capacity for turning points, one of it for the newest; 32 is the longest array for which serde has an implementation.
pub const CAPACITY: usize = 32;

/// A counted cycle, in the unit of the history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadCycle {
    /// Peak minus valley.
    pub range: f64,
    /// Middle between both.
    pub mean: f64,
    /// ½ or 1.
    pub count: f64,
}

impl LoadCycle {
    fn between(a: f64, b: f64, count: f64) -> Self {
        Self { range: (a - b).abs(), mean: a / 2.0 + b / 2.0, count }
    }
}

/// History so far: `Copy`, no allocation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rainflow {
    /// Peaks and valleys not yet discarded, the starting point first.
    points: [f64; CAPACITY],
    /// How many.
    length: usize,
    /// Last value in the present direction: the next turning point, if the direction changes. While none is known, the highest
    /// value so far, the starting point being the lowest.
    candidate: f64,
    /// Direction: 1 rising, −1 falling, 0 not known yet.
    direction: i8,
    /// Reversals up to this are no turning points.
    gate: f64,
    /// True if the history ends where it begins, so that every cycle closes.
    returns: bool,
}

finite!(Rainflow { points, candidate, gate; length, direction, returns });

impl Rainflow {
    /// Empty history in which reversals up to `gate` (unit of the history) are ignored; 0 counts all.
    pub fn new(gate: f64) -> Self {
        Self { gate: if gate > 0.0 && gate.is_finite() { gate } else { 0.0 }, ..Self::default() }
    }

    /// Empty history that is to end where it begins: nothing counts as a half cycle, and [`Self::rest_of_return`] closes all.
    pub fn returning(gate: f64) -> Self {
        Self { returns: true, ..Self::new(gate) }
    }

    /// True if the history ends where it begins.
    pub fn returns(&self) -> bool {
        self.returns
    }

    /// Whether nothing was added yet.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Adds a value and calls `visit` with each cycle that it closes. Values that are no numbers are ignored.
    pub fn push(&mut self, value: f64, mut visit: impl FnMut(LoadCycle)) {
        if !value.is_finite() {
            return;
        }
        self.limit_fields();
        if self.length == 0 {
            self.points[0] = value;
            self.length = 1;
            self.candidate = value;
            self.direction = 0;
            return;
        }
        let onward = (value - self.candidate) * f64::from(self.direction);
        if self.direction == 0 {
            self.set_out(value);
        } else if onward >= 0.0 {
            self.candidate = value;
        } else if onward < -self.gate {
            self.turn(&mut visit);
            self.direction = -self.direction;
            self.candidate = value;
        }
    }

    /// Takes a value while no direction is known. The history starts at the lowest value before it rises and at the highest
    /// before it falls, so that the gate takes nothing from the first range.
    fn set_out(&mut self, value: f64) {
        let (low, high) = (self.points[0], self.candidate);
        if value - low > self.gate {
            (self.direction, self.candidate) = (1, value);
        } else if high - value > self.gate {
            (self.points[0], self.direction, self.candidate) = (high, -1, value);
        } else {
            (self.points[0], self.candidate) = (low.min(value), high.max(value));
        }
    }

    /// Calls `visit` with the remaining half cycles, the present value taken as the last turning point; the history itself is
    /// unchanged and may continue.
    pub fn rest(&self, mut visit: impl FnMut(LoadCycle)) {
        let mut last = *self;
        last.limit_fields();
        if last.direction != 0 {
            last.turn(&mut visit);
        }
        for pair in last.points[..last.length].windows(2) {
            visit(LoadCycle::between(pair[0], pair[1], 0.5));
        }
    }

    /// Calls `visit` with the remaining cycles of a history that goes from its present value to where it began, the largest one
    /// last; the history itself is unchanged.
    pub fn rest_of_return(&self, mut visit: impl FnMut(LoadCycle)) {
        let mut last = *self;
        last.limit_fields();
        if last.length == 0 {
            return;
        }
        last.push(self.points[0], &mut visit);
        if last.direction != 0 {
            last.turn(&mut visit);
        }
        // the same once more: between two of its largest peaks everything closes, and the rest is what was there before
        let mut twice = Self { gate: 0.0, ..Self::returning(0.0) };
        for &point in last.points[..last.length].iter().chain(&last.points[..last.length]) {
            twice.push(point, &mut visit);
        }
    }

    /// Limits the fields: a state read from foreign bytes may hold any length and direction.
    fn limit_fields(&mut self) {
        self.length = self.length.min(CAPACITY - 1);
        self.direction = self.direction.signum();
    }

    /// Makes the candidate a turning point and counts the ranges that it closes.
    fn turn(&mut self, visit: &mut impl FnMut(LoadCycle)) {
        let value = self.candidate;
        let top = self.length.saturating_sub(1);
        let like_top = top > 0 && (self.points[top] > self.points[top - 1]) == (self.direction > 0);
        if like_top {
            // the point between was counted when the stack was full; of two peaks in a row the higher one stays
            if (value - self.points[top]) * f64::from(self.direction) > 0.0 {
                self.points[top] = value;
            }
        } else {
            self.points[self.length] = value;
            self.length += 1;
        }
        self.close(visit);
        if self.length < CAPACITY {
            return;
        }
        let [first, second] = [self.points[0], self.points[1]];
        let last = self.points[CAPACITY - 2] - self.points[CAPACITY - 1];
        if self.returns && (second - first).abs() < last.abs() {
            // ranges grow from the bottom before they decrease toward the top
            visit(LoadCycle::between(first, second, 0.5));
            self.points.copy_within(1.., 0);
            self.length -= 1;
        } else {
            // ranges decrease toward the top: the last one is the smallest
            visit(LoadCycle::between(self.points[CAPACITY - 2], self.points[CAPACITY - 1], 1.0));
            self.length -= 1;
        }
    }

    /// Steps 2 to 5 of the standard: X is the last range, Y the one before. In a history that returns, ranges may grow from the
    /// start, and Y must also be no larger than the one before it.
    fn close(&mut self, visit: &mut impl FnMut(LoadCycle)) {
        while self.length >= 3 {
            let [a, b, c] = [self.points[self.length - 3], self.points[self.length - 2], self.points[self.length - 1]];
            if (c - b).abs() < (b - a).abs() {
                break;
            }
            if self.returns {
                let before = self.length.checked_sub(4).map(|place| (a - self.points[place]).abs());
                if before.is_none_or(|before| (b - a).abs() > before) {
                    break;
                }
            }
            if self.length == 3 {
                // Y holds the starting point: half a cycle, the start moves on
                visit(LoadCycle::between(a, b, 0.5));
                self.points[0] = b;
                self.points[1] = c;
                self.length = 2;
            } else {
                visit(LoadCycle::between(a, b, 1.0));
                self.points[self.length - 3] = c;
                self.length -= 2;
            }
        }
    }
}

//! Rainflow counting of a load history while it is recorded, ASTM E1049-85 (2017), section 5.4.4.
//!
//! It counts the load cycles of a tooth. Peaks and valleys are stored on a stack of fixed size. Ranges on the stack
//! decrease from the bottom to the top, so only a decaying oscillation fills it. If it is full, the smallest range is
//! immediately counted as a full cycle. This is exact if the load exceeds the range again, and conservative otherwise.
//! Nothing is lost, and larger ranges stay unchanged.

use serde::{Deserialize, Serialize};

use crate::numeric::Finite;

/// Capacity for turning points, including one for the newest. 32 is the longest array that serde supports.
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

/// Load history so far, reduced to the turning points that are still needed. The type is `Copy` and allocates nothing.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
#[serde(from = "Points", into = "Points")]
pub struct Rainflow {
    /// Peaks and valleys not yet discarded, starting with the first value.
    points: [f64; CAPACITY],
    /// Number of these points.
    length: usize,
    /// Last value in the present direction, which becomes the next turning point if the direction changes. While the
    /// direction is unknown, it is the highest value so far, and the first point is the lowest.
    candidate: f64,
    /// Direction: 1 rising, −1 falling, 0 unknown.
    direction: i8,
    /// Largest reversal that is not a turning point.
    gate: f64,
    /// Last value.
    last: f64,
}

/// Saved form of a history: only the points in use.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Points {
    points: Vec<f64>,
    candidate: f64,
    direction: i8,
    gate: f64,
    last: f64,
}

impl From<Rainflow> for Points {
    fn from(history: Rainflow) -> Self {
        let Rainflow { candidate, direction, gate, last, .. } = history;
        Self { points: history.points().to_vec(), candidate, direction, gate, last }
    }
}

impl From<Points> for Rainflow {
    /// Limits the fields, because foreign bytes may contain any number of points and any direction.
    fn from(saved: Points) -> Self {
        let Points { candidate, direction, gate, last, .. } = saved;
        let length = saved.points.len().min(CAPACITY - 1);
        let mut points = [0.0; CAPACITY];
        points[..length].copy_from_slice(&saved.points[..length]);
        Self { points, length, candidate, direction: direction.signum(), gate, last }
    }
}

impl PartialEq for Rainflow {
    /// Compares the points in use.
    fn eq(&self, other: &Self) -> bool {
        let rest = |of: &Self| (of.candidate, of.direction, of.gate, of.last);
        self.points() == other.points() && rest(self) == rest(other)
    }
}

impl Finite for Rainflow {
    fn is_finite(&self) -> bool {
        self.points().iter().chain(&[self.candidate, self.gate, self.last]).all(|value| value.is_finite())
    }
}

impl Rainflow {
    /// Returns an empty history that ignores reversals up to `gate` (unit of the history); 0 counts all.
    pub fn new(gate: f64) -> Self {
        Self { gate: if gate > 0.0 && gate.is_finite() { gate } else { 0.0 }, ..Self::default() }
    }

    /// Last value; 0 before the first.
    pub fn last(&self) -> f64 {
        self.last
    }

    /// Turning points in use.
    fn points(&self) -> &[f64] {
        &self.points[..self.length]
    }

    /// True if no value has been added yet.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Adds a value and calls `visit` with each cycle that it closes. Values that are not finite are ignored.
    pub fn push(&mut self, value: f64, mut visit: impl FnMut(LoadCycle)) {
        if !value.is_finite() {
            return;
        }
        self.last = value;
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

    /// Adds a value while the direction is unknown. The history starts at the lowest value before it rises, or at the
    /// highest before it falls, so that the gate does not reduce the first range.
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

    /// Calls `visit` with the remaining half cycles, with the present value as the last turning point. The history
    /// itself is unchanged and may continue.
    pub fn rest(&self, mut visit: impl FnMut(LoadCycle)) {
        let mut last = *self;
        if last.direction != 0 {
            last.turn(&mut visit);
        }
        for pair in last.points().windows(2) {
            visit(LoadCycle::between(pair[0], pair[1], 0.5));
        }
    }

    /// Turns the candidate into a turning point and counts the ranges that it closes.
    fn turn(&mut self, visit: &mut impl FnMut(LoadCycle)) {
        let value = self.candidate;
        let top = self.length.saturating_sub(1);
        let like_top = top > 0 && (self.points[top] > self.points[top - 1]) == (self.direction > 0);
        if like_top {
            // the point between was counted when the stack was full; the higher of two consecutive peaks stays
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
        // ranges decrease toward the top: the last one is the smallest
        visit(LoadCycle::between(self.points[CAPACITY - 2], self.points[CAPACITY - 1], 1.0));
        self.length -= 1;
    }

    /// Steps 2 to 5 of the standard: X is the last range, Y the previous one.
    fn close(&mut self, visit: &mut impl FnMut(LoadCycle)) {
        while self.length >= 3 {
            let [a, b, c] = [self.points[self.length - 3], self.points[self.length - 2], self.points[self.length - 1]];
            if (c - b).abs() < (b - a).abs() {
                break;
            }
            if self.length == 3 {
                // Y contains the starting point: count half a cycle and move the start
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

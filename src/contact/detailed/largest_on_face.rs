//! Search over the loaded face of a sliding tooth pair for the largest value of a quantity.
//!
//! Sliding speed, sum of speeds and radius are proportional to the cone distance R. The load per width is R ω, where ω
//! follows the law of a slice at its arc. The points over which loads are summed do not include the ends of the face,
//! and aligned teeth have only one point. The search therefore evaluates the laws at any R: at both ends of each loaded
//! part, at points between them, and around each point that exceeds its neighbours. Its result does not depend on how
//! the loads were summed, so it is continuous in every error.

use super::loaded_span::{Span, loaded_span};
use super::{Detailed, Face, SliceLoad};
use crate::contact::{Sliding, Spring, ToothFriction};

/// Number of intervals of a part before refinement.
const INTERVALS: usize = 16;
/// Number of golden-section steps around a point that exceeds its neighbours. They shrink its interval to 1e-7 of its
/// length.
const SECTIONS: usize = 34;
/// Ratio of the golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Flanks of a pair at one cone distance.
#[derive(Clone, Copy, Debug)]
pub struct SlidingPoint {
    /// Cone distance [m].
    pub cone: f64,
    /// Sliding, with the load per width at this cone distance.
    pub sliding: Sliding<f64>,
    /// Coefficient of friction with the sign of the sliding speed.
    pub coefficient: f64,
}

impl Detailed {
    /// Largest `value`, at least 0, over the loaded face of the pair of `slice`, under the friction `law`. If a law has
    /// one resultant for the face, only its cone distance is evaluated.
    pub fn largest_on_face(&self, slice: &SliceLoad, law: &ToothFriction, value: impl Fn(&SlidingPoint) -> f64) -> f64 {
        let Some(here) = &slice.sliding else { return 0.0 };
        let value_at = |cone: f64, load: f64| {
            let grown = cone / slice.cone;
            let (sliding, sum_speed) = (here.sliding * grown, here.sum_speed * grown);
            let sliding = Sliding { sliding, sum_speed, load, radius: here.radius * grown };
            value(&SlidingPoint { cone, sliding, coefficient: law.signed(&sliding) })
        };
        let Some([inner, outer]) = self.friction_face.as_ref().and_then(Face::ends) else {
            return value_at(slice.cone, here.load).max(0.0);
        };
        let (opening, local) = (slice.opening, self.spring.local(slice.s));
        let (edge, depth) = opening.edge.unwrap_or((outer, 0.0));
        let edge = edge.clamp(inner, outer);
        let approach = slice.approach.arc - opening.turn;
        let mut largest = 0.0f64;
        for (even, [from, to]) in [(opening.even.v, [inner, edge]), (opening.even.v + depth, [edge, outer])] {
            if from >= to {
                continue;
            }
            let Some(Span { ends, .. }) = loaded_span(approach, even, opening.bend, [from, to]) else { continue };
            largest = largest.max(largest_between(ends, |cone| {
                let arc = approach - even / cone - opening.bend * cone;
                value_at(cone, self.line_load_at(&local, &slice.approach, arc, cone))
            }));
        }
        largest
    }
}

/// Largest value of `f` on [from, to], both ends included.
fn largest_between([from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    let at = |i: usize| if i == INTERVALS { to } else { from + (to - from) * i as f64 / INTERVALS as f64 };
    let values: [f64; INTERVALS + 1] = std::array::from_fn(|i| f(at(i)));
    let mut largest = 0.0f64;
    for (i, &value) in values.iter().enumerate() {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(INTERVALS));
        largest = largest.max(value);
        if value > 0.0 && value >= values[before] && value >= values[after] {
            largest = largest.max(peak(at(before), at(after), &f));
        }
    }
    largest
}

/// Largest value of `f` near its only peak between `low` and `high`, by the golden section.
fn peak(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut left, mut right] = inner(low, high);
    let (mut at_left, mut at_right) = (f(left), f(right));
    for _ in 0..SECTIONS {
        if at_left > at_right {
            (high, right, at_right) = (right, left, at_left);
            left = inner(low, high)[0];
            at_left = f(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = inner(low, high)[1];
            at_right = f(right);
        }
    }
    at_left.max(at_right)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_value_is_at_an_end_inside_or_at_one_of_two_peaks() {
        assert_eq!(largest_between([1.0, 3.0], |x| x), 3.0);
        assert_eq!(largest_between([1.0, 3.0], |x| 4.0 - x), 3.0);
        assert_eq!(largest_between([1.0, 3.0], |_| -1.0), 0.0);
        for top in [1.0001, 1.37, 2.0, 2.9999] {
            assert!((largest_between([1.0, 3.0], |x| 5.0 - (x - top) * (x - top)) - 5.0).abs() < 1e-12, "{top}");
        }
        // two peaks of nearly the same height
        let bumps =
            |x: f64| 2.0 * (-40.0 * (x - 1.31) * (x - 1.31)).exp() + 2.0001 * (-40.0 * (x - 2.64) * (x - 2.64)).exp();
        assert!((largest_between([1.0, 3.0], bumps) - 2.0001).abs() < 1e-9);
    }
}

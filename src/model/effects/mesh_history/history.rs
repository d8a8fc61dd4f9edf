//! Extremes within the present mesh cycle, and peak-to-peak values of the last whole one.
//!
//! A mesh cycle is one tooth of every planet past a side gear: half the difference of both side gears' angles by one tooth
//! pitch. Cycles begin where the motion began, and at whole pitches from there; one in which rolling returns past its
//! beginning begins again. Rolling forward or backward thus divides the motion in the same way.

use serde::{Deserialize, Serialize};

use crate::integrate::Curve;
use crate::model::scene::{MAX_GROUPS, MAX_PLANETS, Plan};
use crate::numeric::Finite;

/// Most quantities: speeds of both side gears, then transmission errors by group of planets and side.
pub const MOST_QUANTITIES: usize = 2 + 2 * MAX_GROUPS;

/// Least and largest value of a quantity.
type Extremes = [f64; 2];

/// What is kept from step to step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeshHistory {
    /// Cycles rolled since the present one began, backward negative.
    rolled: f64,
    /// Extremes since then.
    extremes: Option<[Extremes; MOST_QUANTITIES]>,
    /// Peak-to-peak values over the last whole cycle; 0 before.
    last: [f64; MOST_QUANTITIES],
}

impl MeshHistory {
    /// Adds the part of a step up to its fraction `part`: its rolling in cycles, and the quantities in their order.
    ///
    /// Whole cycles are counted, not run through: a step may have any number of them, and only the last leaves a value.
    pub fn add(&mut self, rolling: &Curve, quantities: &[Curve], part: f64) {
        let (mut from, mut begin) = (0.0, rolling.at(0.0) - self.rolled);
        let rolled = rolling.at(part) - begin;
        if rolled * self.rolled < 0.0 {
            from = rolling.crossing(begin, [from, part]);
            self.extremes = None;
        }
        let whole = rolled.trunc();
        if whole != 0.0 {
            if whole.abs() > 1.0 {
                from = rolling.crossing(begin + (whole - whole.signum()), [from, part]);
                self.extremes = None;
            }
            begin += whole;
            let to = rolling.crossing(begin, [from, part]);
            self.extend(quantities, [from, to]);
            self.last = self.extremes.take().unwrap_or_default().map(|[least, largest]| largest - least);
            from = to;
        }
        self.extend(quantities, [from, part]);
        // angles so large that rounding takes whole cycles from them have no place within one
        let rest = rolling.at(part) - begin;
        self.rolled = if rest.abs() < 1.0 { rest } else { 0.0 };
    }

    /// Extends the extremes over a span of a step.
    fn extend(&mut self, quantities: &[Curve], span: [f64; 2]) {
        let is_new = self.extremes.is_none();
        let all = self.extremes.get_or_insert_default();
        for (curve, extremes) in quantities.iter().zip(all) {
            if is_new {
                *extremes = [curve.at(span[0]); 2];
            }
            curve.extend(extremes, span);
        }
    }

    /// Sets the readings: both side gears, then each planet with both.
    pub fn read(&self, plan: &Plan, readings: &mut [f64]) {
        let (speeds, errors) = readings.split_at_mut(2);
        speeds.copy_from_slice(&self.last[..2]);
        for (planet, errors) in errors.chunks_exact_mut(2).enumerate().take(plan.planets.min(MAX_PLANETS)) {
            let first = 2 + 2 * plan.group_of[planet];
            errors.copy_from_slice(&self.last[first..first + 2]);
        }
    }

    /// Whether a simulation can continue from all numbers.
    pub fn is_valid(&self) -> bool {
        let Self { rolled, extremes, last } = self;
        rolled.abs() < 1.0 && extremes.is_finite() && last.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line.
    fn line(start: f64, end: f64) -> Curve {
        Curve { start, end, coefficients: [0.0; 3] }
    }

    /// Peak-to-peak values of a quantity that is the place itself, rolling from place to place in cycles.
    fn rolled(places: &[f64]) -> MeshHistory {
        let mut history = MeshHistory::default();
        for pair in places.windows(2) {
            let curve = line(pair[0], pair[1]);
            history.add(&curve, &[curve], 1.0);
        }
        history
    }

    #[test]
    fn a_whole_cycle_either_way_gives_the_range_of_its_quantity() {
        for sign in [1.0, -1.0] {
            let places = |count: i32| (0..count).map(|i| sign * 0.15 * f64::from(i)).collect::<Vec<_>>();
            assert_eq!(rolled(&places(7)).last[0], 0.0);
            let history = rolled(&places(8));
            assert!((history.last[0] - 1.0).abs() < 1e-15);
            assert!((history.rolled - sign * 0.05).abs() < 1e-15);
        }
    }

    #[test]
    fn several_cycles_in_a_step_leave_the_last() {
        let mut history = MeshHistory::default();
        // 2 s of a quantity that grows as it rolls
        history.add(&line(0.0, 3.5), &[line(0.0, 7.0)], 1.0);
        assert!((history.last[0] - 2.0).abs() < 1e-14 && (history.rolled - 0.5).abs() < 1e-14);
        let [least, largest] = history.extremes.unwrap()[0];
        assert!((least - 6.0).abs() < 1e-14 && (largest - 7.0).abs() < 1e-14);
    }

    #[test]
    fn cycles_without_number_are_counted_at_once() {
        // more cycles than could be run through, up to those that no number resolves, either way
        for cycles in [1e6 + 0.5, 1e12 + 0.25, 1e17, 1e40, 1e300] {
            for sign in [1.0, -1.0] {
                for start in [0.0, 0.375, 3e16] {
                    let mut history = MeshHistory { rolled: 0.125 * sign, ..MeshHistory::default() };
                    history.add(&line(start, start + sign * cycles), &[line(0.0, 1.0)], 1.0);
                    assert!(history.is_valid(), "{cycles} {sign} {start}: {history:?}");
                    // the share of a step that one cycle takes, to what the place's own digits leave of it
                    let left = (history.last[0] - 1.0 / cycles).abs();
                    let digits = (start + cycles) / cycles * 4.0 * f64::EPSILON;
                    assert!(left <= digits, "{cycles} {sign} {start}: {}", history.last[0]);
                }
            }
        }
    }

    #[test]
    fn a_way_out_and_back_is_no_cycle() {
        let history = rolled(&[0.0, 0.8, -0.1, 0.9, -0.9]);
        assert_eq!(history.last, [0.0; MOST_QUANTITIES]);
        assert!((rolled(&[0.0, 0.8, -1.05]).last[0] - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_step_in_parts_is_the_step() {
        let rolling = Curve { start: 0.3, end: 1.6, coefficients: [0.02, -0.05, 0.01] };
        let quantity = Curve { start: 1.0, end: 0.5, coefficients: [4.0, -9.0, 3.0] };
        let mut whole = MeshHistory::default();
        whole.add(&rolling, &[quantity], 1.0);
        for part in [0.2, 0.5, 0.9] {
            let mut cut = MeshHistory::default();
            cut.add(&rolling, &[quantity], part);
            let reached = rolling.at(part) - rolling.at(0.0);
            assert!((cut.rolled - (reached - reached.trunc())).abs() < 1e-14);
            let done = (reached >= 1.0).then_some(whole.last[0]);
            assert!((cut.last[0] - done.unwrap_or(0.0)).abs() < 1e-9, "{part}");
        }
    }
}

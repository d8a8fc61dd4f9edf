//! Extremes within the present mesh cycle, and peak-to-peak values of the last whole cycle.
//!
//! In a mesh cycle, one tooth of every planet passes a side gear: half the difference of both side gears' angles
//! changes by one tooth pitch. The first cycle begins at the start of the motion, and the others at whole pitches from
//! there. If rolling returns past the beginning of a cycle, the cycle starts again. Forward and backward rolling
//! therefore divide the motion in the same way.

use serde::{Deserialize, Serialize};

use crate::integrate::Curve;
use crate::model::effect_kinds::Memory;
use crate::model::scene::{MAX_GROUPS, MAX_PLANETS, Plan};
use crate::numeric::Finite;

/// Maximum number of quantities: speeds of both side gears, then transmission errors by group of planets and side.
pub const MOST_QUANTITIES: usize = 2 + 2 * MAX_GROUPS;

/// Minimum and maximum of a quantity.
type Extremes = [f64; 2];

/// Extremes and peak-to-peak values, carried from step to step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeshHistory {
    /// Cycles rolled since the present cycle began; negative for backward rolling.
    rolled: f64,
    /// Extremes since the present cycle began.
    extremes: Option<[Extremes; MOST_QUANTITIES]>,
    /// Peak-to-peak values over the last whole cycle; 0 before the first one is complete.
    last: [f64; MOST_QUANTITIES],
}

impl MeshHistory {
    /// Adds a step up to its `accepted_fraction`. `rolling` is the position along the step in mesh cycles, and
    /// `quantities` have the order of [`MOST_QUANTITIES`].
    ///
    /// A step may contain any number of whole cycles. They are counted without a loop, and only the last one gives
    /// values.
    pub fn add(&mut self, rolling: &Curve, quantities: &[Curve], accepted_fraction: f64) {
        let (mut from, mut begin) = (0.0, rolling.at(0.0) - self.rolled);
        let rolled = rolling.at(accepted_fraction) - begin;
        if rolled * self.rolled < 0.0 {
            from = rolling.crossing(begin, [from, accepted_fraction]);
            self.extremes = None;
        }
        let whole = rolled.trunc();
        if whole != 0.0 {
            if whole.abs() > 1.0 {
                from = rolling.crossing(begin + (whole - whole.signum()), [from, accepted_fraction]);
                self.extremes = None;
            }
            begin += whole;
            let to = rolling.crossing(begin, [from, accepted_fraction]);
            self.extend(quantities, [from, to]);
            self.last = self.extremes.take().unwrap_or_default().map(|[least, largest]| largest - least);
            from = to;
        }
        self.extend(quantities, [from, accepted_fraction]);
        // if an angle is so large that its rounding exceeds a cycle, the position within the cycle is unknown
        let rest = rolling.at(accepted_fraction) - begin;
        self.rolled = if rest.abs() < 1.0 { rest } else { 0.0 };
    }

    /// Extends the extremes over a span of fractions of a step.
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

    /// Sets the readings: both side gears, then each planet with both side gears.
    pub fn read(&self, plan: &Plan, readings: &mut [f64]) {
        let (speeds, errors) = readings.split_at_mut(2);
        speeds.copy_from_slice(&self.last[..2]);
        for (planet, errors) in errors.chunks_exact_mut(2).enumerate().take(plan.planets.min(MAX_PLANETS)) {
            let first = 2 + 2 * plan.group_of[planet];
            errors.copy_from_slice(&self.last[first..first + 2]);
        }
    }
}

impl Memory for MeshHistory {
    type Checkpoint = Self;

    fn checkpoint(&mut self) -> Self {
        *self
    }

    fn roll_back(&mut self, to: Self) {
        *self = to;
    }

    fn is_valid(&self) -> bool {
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

    /// History of a quantity that equals the position, while the gears roll through `positions` in cycles.
    fn rolled(positions: &[f64]) -> MeshHistory {
        let mut history = MeshHistory::default();
        for pair in positions.windows(2) {
            let curve = line(pair[0], pair[1]);
            history.add(&curve, &[curve], 1.0);
        }
        history
    }

    #[test]
    fn a_whole_cycle_either_way_gives_the_range_of_its_quantity() {
        for sign in [1.0, -1.0] {
            let positions = |count: i32| (0..count).map(|i| sign * 0.15 * f64::from(i)).collect::<Vec<_>>();
            assert_eq!(rolled(&positions(7)).last[0], 0.0);
            let history = rolled(&positions(8));
            assert!((history.last[0] - 1.0).abs() < 1e-15);
            assert!((history.rolled - sign * 0.05).abs() < 1e-15);
        }
    }

    #[test]
    fn several_cycles_in_a_step_leave_the_values_of_the_last() {
        let mut history = MeshHistory::default();
        // the quantity grows by 2 in each of 3.5 cycles
        history.add(&line(0.0, 3.5), &[line(0.0, 7.0)], 1.0);
        assert!((history.last[0] - 2.0).abs() < 1e-14 && (history.rolled - 0.5).abs() < 1e-14);
        let [least, largest] = history.extremes.unwrap()[0];
        assert!((least - 6.0).abs() < 1e-14 && (largest - 7.0).abs() < 1e-14);
    }

    #[test]
    fn any_number_of_cycles_is_counted_without_a_loop() {
        // more cycles than a loop could handle, up to numbers that do not resolve a single cycle, in both directions
        for cycles in [1e6 + 0.5, 1e12 + 0.25, 1e17, 1e40, 1e300] {
            for sign in [1.0, -1.0] {
                for start in [0.0, 0.375, 3e16] {
                    let mut history = MeshHistory { rolled: 0.125 * sign, ..MeshHistory::default() };
                    history.add(&line(start, start + sign * cycles), &[line(0.0, 1.0)], 1.0);
                    assert!(history.is_valid(), "{cycles} {sign} {start}: {history:?}");
                    // fraction of a step that one cycle takes, within the resolution of the position
                    let left = (history.last[0] - 1.0 / cycles).abs();
                    let digits = (start + cycles) / cycles * 4.0 * f64::EPSILON;
                    assert!(left <= digits, "{cycles} {sign} {start}: {}", history.last[0]);
                }
            }
        }
    }

    #[test]
    fn rolling_out_and_back_does_not_complete_a_cycle() {
        let history = rolled(&[0.0, 0.8, -0.1, 0.9, -0.9]);
        assert_eq!(history.last, [0.0; MOST_QUANTITIES]);
        assert!((rolled(&[0.0, 0.8, -1.05]).last[0] - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_step_up_to_a_fraction_agrees_with_the_whole_step() {
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

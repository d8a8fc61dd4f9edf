//! Times at which steps end in addition to regular steps: jumps and corners of tables, and changes of values.

use crate::table::{Rule, Table};

/// Points that deviate from a straight line by less than this fraction of the largest value of their table are on it.
const STRAIGHT: f64 = 1e-9;

/// Reason why a step ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reason {
    /// A value jumps. The record has a row before the jump and a row after it.
    Jump,
    /// A point of a table in a run without regular steps. The record has a row.
    Point,
    /// The slope of a table changes between two regular steps. The record has no row.
    Corner,
}

/// Times at which steps end, once or in each period.
#[derive(Clone, Debug)]
pub(crate) struct Stops {
    /// Times [s] in ascending order, within the first period if they repeat, with their reasons.
    times: Vec<(f64, Reason)>,
    /// Time after which the stops repeat [s]; `None` = they come once.
    period: Option<f64>,
    /// Number of passed stops.
    pub(crate) passed: usize,
}

impl Stops {
    /// Stops at changes of values at `times` [s], in ascending order.
    pub(crate) fn at_changes(times: Vec<f64>) -> Self {
        Self { times: times.into_iter().map(|time| (time, Reason::Jump)).collect(), period: None, passed: 0 }
    }

    /// Stops at the jumps of `table`, and at its corners if an input follows it within steps. If `points` is true, all
    /// points are stops.
    pub(crate) fn of(table: &Table, points: bool) -> Self {
        let knots = Knots::of(table);
        let is_stop = |reason| points || table.rule == Rule::Linear || reason == Reason::Jump;
        let reason = |(time, reason): (f64, Option<Reason>)| {
            let reason = reason.or(points.then_some(Reason::Point))?;
            let shown = if points && reason == Reason::Corner { Reason::Point } else { reason };
            Some((time, shown)).filter(|_| is_stop(reason))
        };
        let at_wrap = table.period.map(|period| (0.0, knots.reason_at_wrap(period)));
        let times = at_wrap.into_iter().chain(knots.inner()).filter_map(reason).filter(|(time, _)| *time >= 0.0);
        Self { times: times.collect(), period: table.period, passed: 0 }
    }

    /// Number of stops up to the time `stop` [s].
    pub(crate) fn count(&self, stop: f64) -> f64 {
        self.times.len() as f64 * self.period.map_or(1.0, |period| stop / period)
    }

    /// The next stop [s], or `None` if all stops have passed.
    pub(crate) fn upcoming(&self) -> Option<f64> {
        self.nth(self.passed).map(|(time, _)| time)
    }

    /// Reasons of the next stops up to `time` [s].
    pub(crate) fn reasons_until(&self, time: f64) -> impl Iterator<Item = Reason> {
        let ahead = (self.passed..).map_while(|index| self.nth(index));
        ahead.take_while(move |&(next, _)| next <= time).map(|(_, reason)| reason)
    }

    /// Passes all stops up to `time` [s]. Returns true if there was a jump among them.
    pub(crate) fn pass(&mut self, time: f64) -> bool {
        let count = self.reasons_until(time).count();
        let jumps = self.reasons_until(time).any(|reason| reason == Reason::Jump);
        self.passed += count;
        jumps
    }

    /// The stop number `index`, counted over all periods.
    fn nth(&self, index: usize) -> Option<(f64, Reason)> {
        let Some(period) = self.period else { return self.times.get(index).copied() };
        let count = self.times.len();
        (count > 0).then(|| {
            let (time, reason) = self.times[index % count];
            ((index / count) as f64 * period + time, reason)
        })
    }
}

/// Points of a table, with a point at each end of the time for which they describe it.
struct Knots {
    /// Times [s] and values.
    points: Vec<(f64, f64)>,
    /// Deviation from a straight line that counts as none.
    tolerance: f64,
    /// Rule of the table.
    rule: Rule,
}

impl Knots {
    /// One period of a table that repeats. Otherwise all its points, and the constant values around them.
    fn of(table: &Table) -> Self {
        let given = table.times.iter().copied().zip(table.values.iter().copied());
        let ends = [given.clone().next(), given.clone().next_back()].map(|end| end.unwrap_or_default());
        let [first, last] = match table.period {
            Some(period) => [(0.0, table.at(0.0)), (period, table.before(period))],
            None => [(ends[0].0 - 1.0, ends[0].1), (ends[1].0 + 1.0, ends[1].1)],
        };
        let inner = given.filter(|&(time, _)| first.0 < time && time < last.0);
        let points: Vec<(f64, f64)> = [first].into_iter().chain(inner).chain([last]).collect();
        let largest = points.iter().fold(0.0, |largest: f64, (_, value)| largest.max(value.abs()));
        Self { points, tolerance: STRAIGHT * largest, rule: table.rule }
    }

    /// Times of the points between both ends [s], each with the reason to stop there, if there is one.
    ///
    /// A point has no reason if the straight line from the last stop to the next point passes all points between them
    /// within the tolerance. `low` and `high` are the slopes of lines from the last stop that have passed all points so
    /// far.
    fn inner(&self) -> Vec<(f64, Option<Reason>)> {
        let points = &self.points;
        let mut found: Vec<(f64, Option<Reason>)> = points.iter().map(|&(time, _)| (time, None)).collect();
        let (mut last, mut low, mut high) = (points[0], f64::NEG_INFINITY, f64::INFINITY);
        for next in 1..points.len() {
            let (before, (time, value)) = (points[next - 1], points[next]);
            let is_jump = time == before.0 || (self.rule == Rule::Held && value != before.1);
            let slope = |from: (f64, f64), value: f64| (value - from.1) / (time - from.0);
            if is_jump {
                let place = if time == before.0 { next - 1 } else { next };
                found[place].1 = Some(Reason::Jump);
                (last, low, high) = (points[next], f64::NEG_INFINITY, f64::INFINITY);
                continue;
            }
            if !(low..=high).contains(&slope(last, value)) {
                found[next - 1].1 = found[next - 1].1.or(Some(Reason::Corner));
                (last, low, high) = (before, f64::NEG_INFINITY, f64::INFINITY);
            }
            low = low.max(slope(last, value - self.tolerance));
            high = high.min(slope(last, value + self.tolerance));
        }
        found.pop();
        found.split_off(1)
    }

    /// Reason to stop at the end of each period [s], if there is one.
    fn reason_at_wrap(&self, period: f64) -> Option<Reason> {
        let points = &self.points;
        let (&(_, first), &(_, last)) = (points.first()?, points.last()?);
        if first != last {
            return Some(Reason::Jump);
        }
        let ((before, from), (after, to)) = (points[points.len() - 2], points[1]);
        let share = (period - before) / (period - before + after);
        let line = from + share * (to - from);
        ((line - first).abs() > self.tolerance).then_some(Reason::Corner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(times: &[f64], values: &[f64], period: Option<f64>) -> Table {
        Table::straight(times.to_vec(), values.to_vec(), period)
    }

    /// The first stops of a run with a step, for which `reason` is given.
    fn first(table: &Table, count: usize, wanted: Reason) -> Vec<f64> {
        let stops = Stops::of(table, false);
        let found = (0..200_000).map_while(|index| stops.nth(index)).filter(|(_, reason)| *reason == wanted);
        found.map(|(time, _)| time).take(count).collect()
    }

    #[test]
    fn a_jump_comes_again_in_every_period() {
        let square = table(&[0.0, 1.0, 1.0, 3.0], &[1.0, 1.0, 0.0, 0.0], Some(3.0));
        assert_eq!(first(&square, 6, Reason::Jump), [0.0, 1.0, 3.0, 4.0, 6.0, 7.0]);
        // the last point is after the end of the period, and so is the second jump
        let cut = table(&[0.0, 1.0, 1.0, 4.0, 4.0], &[0.0, 1.0, 0.0, 0.0, 9.0], Some(2.0));
        assert_eq!(first(&cut, 3, Reason::Jump), [1.0, 3.0, 5.0]);
        // a period with equal first and last values
        let smooth = table(&[0.0, 0.1, 0.3], &[0.1, 0.7, 0.1], Some(0.3));
        assert!(first(&smooth, 1, Reason::Jump).is_empty());
        let once = table(&[0.0, 1.0, 1.0, 3.0], &[1.0, 1.0, 0.0, 0.0], None);
        assert_eq!(first(&once, 6, Reason::Jump), [1.0]);
        // the end of the period of held values
        let held = Table { rule: Rule::Held, ..table(&[0.0, 1.0, 1.0, 3.0], &[1.0, 1.0, 2.0, 2.0], Some(4.0)) };
        assert_eq!(first(&held, 3, Reason::Jump), [0.0, 1.0, 4.0]);
    }

    #[test]
    fn corners_are_points_at_which_the_slope_changes() {
        for sign in [1.0, -1.0] {
            let values = |values: &[f64]| values.iter().map(|value| sign * value).collect::<Vec<_>>();
            let pulse = table(&[0.0, 0.1, 0.2, 0.3, 0.4, 0.5], &values(&[0.0, 0.0, 0.5, 1.0, 0.0, 0.0]), None);
            assert_eq!(first(&pulse, 9, Reason::Corner), [0.1, 0.3, 0.4]);
            // constant before the first point and after the last one
            let ramp = table(&[0.1, 0.2, 0.3], &values(&[1.0, 2.0, 3.0]), None);
            assert_eq!(first(&ramp, 9, Reason::Corner), [0.1, 0.3]);
            // around the end of its period, the first triangle is straight
            let middle = table(&[0.0, 0.5, 1.5, 2.0], &values(&[0.0, 1.0, -1.0, 0.0]), Some(2.0));
            assert_eq!(first(&middle, 4, Reason::Corner), [0.5, 1.5, 2.5, 3.5]);
            let tip = table(&[0.0, 1.0, 2.0], &values(&[-1.0, 1.0, -1.0]), Some(2.0));
            assert_eq!(first(&tip, 4, Reason::Corner), [0.0, 1.0, 2.0, 3.0]);
            let constant = table(&[0.0, 1.0], &values(&[5.0, 5.0]), Some(2.0));
            assert!(first(&constant, 1, Reason::Corner).is_empty());
            let sampled = Table { rule: Rule::Sampled, ..pulse };
            assert!(first(&sampled, 1, Reason::Corner).is_empty());
        }
    }

    #[test]
    fn a_slowly_bending_table_is_not_replaced_by_a_line() {
        // each point deviates from its neighbours by less than the tolerance
        let times: Vec<f64> = (0..=100_000).map(|i| 1e-5 * f64::from(i)).collect();
        let values: Vec<f64> = times.iter().map(|time| time * time).collect();
        let corners = [vec![0.0], first(&table(&times, &values, None), 100_000, Reason::Corner)].concat();
        let worst = corners.windows(2).map(|pair| 0.25 * (pair[1] - pair[0]).powi(2)).fold(0.0, f64::max);
        assert!(worst < 2.0 * STRAIGHT && corners.len() > 1000, "{worst:e} with {} corners", corners.len());
    }
}

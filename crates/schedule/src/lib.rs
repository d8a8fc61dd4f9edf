//! Schedule of a run: its communication steps, and the values and slopes of its inputs in each step. All players of a
//! scene execute it: the library of answers, the Python package and the page.

#![warn(missing_docs)]
#![deny(unsafe_code)]

#[allow(unsafe_code)] // the one place that handles foreign pointers
mod c;
mod table;

use std::{iter, ops::Range};

pub use c::bd_schedule;
use table::Stops;
pub use table::Table;

/// Times that differ by less than this fraction of a step are equal.
const SAME: f64 = 1e-9;
/// In a run without regular steps, times that differ by less than this fraction of the run are equal. Inputs may change
/// within a small fraction of the run.
const FINEST: f64 = 1e-12;
/// Maximum number of steps, and of stops of a table. Larger numbers are mistakes.
pub const MOST: f64 = 1e8;

/// Steps of a run: to multiples of a step, to changes and jumps of inputs, and to the end.
#[derive(Clone)]
pub struct Schedule {
    /// End of the run [s].
    stop: f64,
    /// Regular step [s]; `None` = steps end only at stops.
    step: Option<f64>,
    /// Times that differ by less than this are equal [s].
    slack: f64,
    /// End of the last step [s].
    time: f64,
    /// Number of completed regular steps.
    done: u64,
    /// Changes, then the stops of each table.
    stops: Vec<Stops>,
}

/// A communication step.
#[derive(Debug)]
pub struct Step {
    begin: f64,
    /// End [s].
    pub end: f64,
    /// Indices of the changes made before the step.
    pub changes: Range<usize>,
    slack: f64,
}

impl Schedule {
    /// Creates the schedule of a run to `stop` [s] in steps of `step` [s]. Inputs change at `changes` [s], in ascending
    /// order, and follow `tables`. Without `step`, steps end only at changes and at points of tables.
    pub fn new<'a>(stop: f64, step: Option<f64>, changes: Vec<f64>, tables: impl Iterator<Item = &'a Table>) -> Self {
        let slack = step.map_or(FINEST * stop, |step| SAME * step.min(stop));
        let of_tables = tables.map(|table| table.stops(step.is_none()));
        let stops = iter::once(Stops { times: changes, period: None, passed: 0 }).chain(of_tables).collect();
        Self { stop, step, slack, time: 0.0, done: 0, stops }
    }

    /// Returns true after the last step.
    pub fn is_over(&self) -> bool {
        self.time >= self.stop
    }

    /// Returns the index of the first table with more than [`MOST`] stops, which is a mistake in its period.
    pub fn table_with_too_many_stops(&self) -> Option<usize> {
        let count = |stops: &Stops| stops.times.len() as f64 * stops.period.map_or(1.0, |period| self.stop / period);
        self.stops[1..].iter().position(|stops| count(stops) > MOST)
    }
}

impl Iterator for Schedule {
    type Item = Step;

    fn next(&mut self) -> Option<Step> {
        if self.is_over() {
            return None;
        }
        let (begin, slack) = (self.time, self.slack);
        let regular = self.step.map_or(self.stop, |step| (self.done + 1) as f64 * step);
        let regular = if regular < self.stop - slack { regular } else { self.stop };
        // changes made so far are complete
        let made = self.stops[0].passed;
        self.stops.iter_mut().for_each(|stops| stops.pass(begin + slack));
        let stop = self.stops.iter().filter_map(Stops::upcoming).min_by(f64::total_cmp);
        let stop = stop.filter(|&time| time < regular - slack);
        self.done += u64::from(stop.is_none());
        self.time = stop.unwrap_or(regular);
        Some(Step { begin, end: self.time, changes: made..self.stops[0].passed, slack })
    }
}

impl Step {
    /// Start and size [s] for hosts: their sum is the end, without rounding.
    pub fn call(&self) -> [f64; 2] {
        let size = self.end - self.begin;
        [self.end - size, size]
    }

    /// Value of `table` just after the start, and its slope from there to just before the end, per second.
    pub fn follow(&self, table: &Table) -> [f64; 2] {
        let (begin, end) = (self.begin + self.slack, self.end - self.slack);
        // between two almost equal times, the slope would be only a rounding error
        let slope = if end - begin > self.slack { table.slope(begin, end) } else { 0.0 };
        [table.at(begin), slope]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schedule(stop: f64, step: Option<f64>, changes: &[f64], tables: &[&Table]) -> Schedule {
        Schedule::new(stop, step, changes.to_vec(), tables.iter().copied())
    }

    /// Ends of steps, rounded [µs].
    fn ends(schedule: Schedule) -> Vec<f64> {
        schedule.map(|step| (step.end * 1e6).round()).collect()
    }

    #[test]
    fn values_and_slopes_give_the_impulse_of_a_table_in_any_steps() {
        let saw = Table::straight(vec![0.0, 0.3], vec![0.0, 3.0], Some(0.3));
        let pulses = Table::straight(vec![0.0, 0.15, 0.15], vec![3.0, 3.0, 0.0], Some(0.3));
        for (table, step) in
            [saw, pulses].iter().flat_map(|table| [Some(0.25), Some(0.07), None].map(|step| (table, step)))
        {
            let impulse = |step: Step| {
                let ([begin, size], [value, slope]) = (step.call(), step.follow(table));
                assert_eq!(begin + size, step.end);
                (value + 0.5 * size * slope) * size
            };
            let all: f64 = schedule(0.9, step, &[], &[table]).map(impulse).sum();
            assert!((all - 1.35).abs() < 1e-8, "{step:?}: {all}");
        }
    }

    #[test]
    fn equal_times_are_one_point() {
        // by rounding, 3 · 0.1 is more than 0.3, and the last change is slightly before the end
        let close = Table::straight(vec![0.3, 0.3, 0.3 + 1e-13, 0.3 + 1e-13], vec![0.0, 1.0, 1.0, 2.0], None);
        let found = ends(schedule(0.7, Some(0.1), &[0.25, 0.25, 0.7 - 1e-14], &[&close]));
        assert_eq!(found, [1e5, 2e5, 2.5e5, 3e5, 4e5, 5e5, 6e5, 7e5]);
    }

    #[test]
    fn changes_are_due_before_the_step_that_begins_with_them() {
        let steps = schedule(1.0, Some(0.5), &[0.0, 0.2, 0.2, 0.5 + 1e-12, 1.0], &[]);
        assert_eq!(
            steps.map(|step| (step.end, step.changes)).collect::<Vec<_>>(),
            [(0.2, 0..1), (0.5, 1..3), (1.0, 3..4)]
        );
    }

    #[test]
    fn without_a_step_points_of_tables_are_ends() {
        let once = Table::straight(vec![0.1, 0.4, 0.4, 2.0], vec![5.0, 20.0, -1.0, 0.0], None);
        assert_eq!(ends(schedule(0.7, None, &[0.6], &[&once])), [1e5, 4e5, 6e5, 7e5]);
        let again = Table::straight(vec![0.1], vec![5.0], Some(0.3));
        assert_eq!(ends(schedule(0.7, None, &[], &[&again])), [1e5, 3e5, 4e5, 6e5, 7e5]);
    }

    #[test]
    fn a_run_of_zero_duration_has_no_step_and_a_run_shorter_than_its_step_has_one() {
        assert_eq!(ends(schedule(0.0, Some(0.1), &[0.0], &[])), []);
        assert_eq!(ends(schedule(1e-6, Some(1e6), &[], &[])), [1.0]);
    }

    #[test]
    fn the_slope_of_a_step_that_a_jump_shortens_almost_to_zero_is_not_a_rounding_error() {
        for off in [1.5e-9, 2e-9, 2.0000001e-9, 2.5e-9, 1e-8] {
            for at in (1..10).map(|k| 0.1 * (f64::from(k) - off)) {
                let jump = Table::straight(vec![at, at, at + 1.0], vec![0.0, 1.0, 2.0], None);
                for step in schedule(1.0, Some(0.1), &[], &[&jump]) {
                    let [_, slope] = step.follow(&jump);
                    assert!(slope == 0.0 || (slope - 1.0).abs() < 1e-3, "{off} {at}: {step:?} {slope}");
                }
            }
        }
    }
}

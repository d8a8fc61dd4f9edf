//! Schedule of a run: its communication steps, and the values and slopes of its inputs in each step. All players of a
//! scene execute it: the library of answers, the Python package and the page.

#![warn(missing_docs)]
#![deny(unsafe_code)]

#[allow(unsafe_code)] // the one place that handles foreign pointers
mod c;
mod stops;
mod table;

use std::{iter, ops::Range};

pub use c::bd_schedule;
use stops::{Reason, Stops};
pub use table::{Rule, Table};

/// Times that differ by less than this fraction of a step are equal.
const SAME: f64 = 1e-9;
/// In a run without regular steps, times that differ by less than this fraction of the run are equal. Inputs may change
/// within a small fraction of the run.
const FINEST: f64 = 1e-12;
/// Maximum number of steps, and of stops of a table. Larger numbers are mistakes.
pub const MOST: f64 = 1e8;
/// Points between communication points make a run much longer if there are more than this number per step, and more
/// than `MANY`.
const PER_STEP: usize = 4;
/// Number of points that no run notices.
const MANY: usize = 100;

/// Steps of a run: to multiples of a step, to changes and jumps of inputs, to points at which the slope of an input
/// changes, and to the end.
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
    /// True if values jump at the start, so that the record has a row with the values after the jump.
    pub begins_with_jump: bool,
    /// True if the record has a row at the end. It has none if only the slope of a table changes there.
    pub is_recorded: bool,
    slack: f64,
}

impl Schedule {
    /// Creates the schedule of a run to `stop` [s] in steps of `step` [s]. Inputs change at `changes` [s], in ascending
    /// order, and follow `tables`. Without `step`, steps end only at changes and at points of tables, and the record has
    /// a row at each.
    pub fn new<'a>(stop: f64, step: Option<f64>, changes: Vec<f64>, tables: impl Iterator<Item = &'a Table>) -> Self {
        let slack = step.map_or(FINEST * stop, |step| SAME * step.min(stop));
        let of_tables = tables.map(|table| Stops::of(table, step.is_none()));
        let stops = iter::once(Stops::at_changes(changes)).chain(of_tables).collect();
        Self { stop, step, slack, time: 0.0, done: 0, stops }
    }

    /// Returns true after the last step.
    pub fn is_over(&self) -> bool {
        self.time >= self.stop
    }

    /// Returns the index of the first table with more than [`MOST`] stops, which is a mistake in its period.
    pub fn table_with_too_many_stops(&self) -> Option<usize> {
        self.stops[1..].iter().position(|stops| stops.count(self.stop) > MOST)
    }

    /// Number of points of tables between the communication points, if these points make the run much longer.
    pub fn points_that_prolong(&self) -> Option<usize> {
        let (mut points, mut others) = (0, 0);
        self.clone().for_each(|step| *(if step.is_recorded { &mut others } else { &mut points }) += 1);
        Some(points).filter(|_| points > MANY && points > PER_STEP * others)
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
        let jumps = self.stops.iter_mut().map(|stops| stops.pass(begin + slack)).fold(false, |any, jumps| any | jumps);
        let changes = made..self.stops[0].passed;
        // tables start with the values after a jump
        let begins_with_jump = if begin > 0.0 { jumps } else { !changes.is_empty() };
        let stop = self.stops.iter().filter_map(Stops::upcoming).min_by(f64::total_cmp);
        let stop = stop.filter(|&time| time < regular - slack);
        self.done += u64::from(stop.is_none());
        let end = stop.unwrap_or(regular);
        self.time = end;
        let mut reasons = self.stops.iter().flat_map(|stops| stops.reasons_until(end + slack));
        let is_recorded = stop.is_none() || reasons.any(|reason| reason != Reason::Corner);
        Some(Step { begin, end, changes, begins_with_jump, is_recorded, slack })
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
        let triangle = Table::straight(vec![0.0, 0.13, 0.17, 0.23], vec![0.0, 0.0, 13.5, 0.0], Some(0.45));
        let saw = Table::straight(vec![0.0, 0.3], vec![0.0, 3.0], Some(0.3));
        let pulses = Table::straight(vec![0.0, 0.15, 0.15], vec![3.0, 3.0, 0.0], Some(0.3));
        for (table, step) in
            [saw, pulses, triangle].iter().flat_map(|table| [Some(0.25), Some(0.07), None].map(|step| (table, step)))
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
    fn a_corner_ends_a_step_without_a_row_and_a_jump_has_two_rows() {
        let given = Table::straight(vec![0.0, 0.15, 0.3, 0.45, 0.45], vec![0.0, 1.5, 0.0, 0.0, 9.0], None);
        let rows = |table: &Table, step, changes: &[f64]| {
            let steps = schedule(0.6, step, changes, &[table]);
            steps.map(|step| ((step.end * 1e3).round(), step.is_recorded, step.begins_with_jump)).collect::<Vec<_>>()
        };
        // the change at the end is not made; the corner at 0.3 s is also a communication point
        let found = rows(&given, Some(0.1), &[0.25, 0.6]);
        let wanted = [
            (100.0, true, false),
            (150.0, false, false),
            (200.0, true, false),
            (250.0, true, false),
            (300.0, true, true),
            (400.0, true, false),
            (450.0, true, false),
            (500.0, true, true),
            (600.0, true, false),
        ];
        assert_eq!(found, wanted);
        // a change at the start has a row; a table starts with its values after a jump
        let jump = Table::straight(vec![0.0, 0.0], vec![0.0, 1.0], None);
        assert_eq!(rows(&jump, Some(0.6), &[0.0]), [(600.0, true, true)]);
        assert_eq!(rows(&jump, Some(0.6), &[]), [(600.0, true, false)]);
        // values that are held within steps have no other stops than jumps
        let sampled = Table { rule: Rule::Sampled, ..given };
        assert_eq!(rows(&sampled, Some(0.3), &[]).iter().map(|row| row.0).collect::<Vec<_>>(), [300.0, 450.0, 600.0]);
    }

    #[test]
    fn points_that_make_a_run_much_longer_are_counted() {
        let zigzag = |points: u32, period| {
            let times = (0..points).map(|i| f64::from(i) / f64::from(points)).collect();
            Table::straight(times, (0..points).map(|i| f64::from(i % 2)).collect(), period)
        };
        // points at communication points do not prolong the run
        assert_eq!(schedule(1.0, Some(0.1), &[], &[&zigzag(1000, None)]).points_that_prolong(), Some(990));
        assert_eq!(schedule(3.0, Some(0.1), &[], &[&zigzag(100, Some(1.0))]).points_that_prolong(), Some(270));
        assert_eq!(schedule(1.0, Some(0.1), &[], &[&zigzag(100, None)]).points_that_prolong(), None);
        assert_eq!(schedule(1.0, Some(0.01), &[], &[&zigzag(300, None)]).points_that_prolong(), None);
        assert_eq!(schedule(1.0, None, &[], &[&zigzag(1000, None)]).points_that_prolong(), None);
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

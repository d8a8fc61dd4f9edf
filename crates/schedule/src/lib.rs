//! The schedule of a run: its communication steps, and the values and slopes of its inputs in each. All players of a scene execute
//! it: the library of answers, the Python package and the page.

#![warn(missing_docs)]
#![deny(unsafe_code)]

#[allow(unsafe_code)] // the one place that handles foreign pointers
mod c;
mod stops;
mod table;

pub use c::bd_schedule;
use stops::Stops;
pub use table::Table;

/// Times that differ by less than this part of a step are the same.
const SAME: f64 = 1e-9;
/// The same as a part of a run without regular steps, whose inputs may change within a small part of it.
const FINEST: f64 = 1e-12;
/// Maximum number of steps, and of stops of a table. More of them are a mistake.
pub const MOST: f64 = 1e8;

/// The steps of a run: to multiples of a step, to changes and jumps of inputs, and to the end.
#[derive(Clone, Debug)]
pub struct Schedule {
    stop: f64,
    step: Option<f64>,
    slack: f64,
    time: f64,
    /// Regular steps done.
    done: u64,
    /// Changes, whose positions are counted: two may have one time.
    changes: Vec<f64>,
    due: usize,
    /// Stops of each table.
    tables: Vec<Stops>,
}

/// A communication step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Beginning and end [s].
    pub begin: f64,
    /// End [s].
    pub end: f64,
    /// Number of changes, counted from the first one of the run, that are made before the step.
    pub due: usize,
    slack: f64,
}

impl Schedule {
    /// Schedule of a run to `stop` [s] in steps of `step` [s], whose inputs change at `changes` [s], which rise, and follow `tables`.
    /// Without a step there are steps only to changes and to points of tables.
    pub fn new<'a>(
        stop: f64,
        step: Option<f64>,
        changes: Vec<f64>,
        tables: impl IntoIterator<Item = &'a Table>,
    ) -> Self {
        let slack = step.map_or(FINEST * stop, |step| SAME * step.min(stop));
        let stops = |table: &Table| if step.is_some() { table.jumps() } else { table.corners() };
        let tables = tables.into_iter().map(stops).collect();
        Self { stop, step, slack, time: 0.0, done: 0, changes, due: 0, tables }
    }

    /// Returns true if there is no further step.
    pub fn is_over(&self) -> bool {
        self.time >= self.stop
    }

    /// Number of regular steps so far.
    pub fn done(&self) -> u64 {
        self.done
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
        // what has been fed is over
        self.tables.iter_mut().for_each(|stops| stops.pass(begin + slack));
        self.due += self.changes[self.due..].iter().take_while(|&&time| time <= begin + slack).count();
        let stops = self.tables.iter().filter_map(Stops::upcoming).chain(self.changes.get(self.due).copied());
        let change = stops.min_by(f64::total_cmp).filter(|&time| time < regular - slack);
        self.done += u64::from(change.is_none());
        self.time = change.unwrap_or(regular);
        Some(Step { begin, end: self.time, due: self.due, slack })
    }
}

impl Step {
    /// Beginning and size [s] as hosts pass them: their sum is the end without any rounding.
    pub fn call(&self) -> [f64; 2] {
        let size = self.end - self.begin;
        [self.end - size, size]
    }

    /// Value of `table` just after the beginning.
    pub fn value(&self, table: &Table) -> f64 {
        table.at(self.begin + self.slack)
    }

    /// Slope of `table` from just after the beginning to just before the end, per second.
    pub fn slope(&self, table: &Table) -> f64 {
        // between two times that are hardly different there is nothing but rounding
        if self.end - self.begin <= 3.0 * self.slack {
            return 0.0;
        }
        table.slope(self.begin + self.slack, self.end - self.slack)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half of each period at 100.
    fn pulses(period: f64) -> Table {
        Table::straight(vec![0.0, 0.5 * period, 0.5 * period], vec![100.0, 100.0, 0.0], Some(period))
    }

    fn ends(schedule: Schedule) -> Vec<f64> {
        schedule.map(|step| step.end).collect()
    }

    #[test]
    fn steps_end_at_every_jump_and_give_the_impulse_of_the_table() {
        let table = pulses(0.1);
        for step in [0.4, 0.08, 0.033] {
            let schedule = Schedule::new(1.0, Some(step), Vec::new(), [&table]);
            let ends = ends(schedule.clone());
            for jump in (1..20).map(|k| 0.05 * f64::from(k)) {
                assert_eq!(
                    ends.iter().filter(|&&end| (end - jump).abs() < 1e-9).count(),
                    1,
                    "{step}: {jump} in {ends:?}"
                );
            }
            let impulse: f64 = schedule.map(|step| step.value(&table) * step.call()[1]).sum();
            assert!((impulse - 50.0).abs() < 1e-9, "{step}: {impulse}");
        }
    }

    #[test]
    fn slopes_give_the_impulse_of_a_saw_in_any_steps() {
        let saw = Table::straight(vec![0.0, 0.3], vec![0.0, 3.0], Some(0.3));
        for step in [Some(0.25), Some(0.07), None] {
            let schedule = Schedule::new(0.9, step, Vec::new(), [&saw]);
            let impulse = |step: Step| {
                let [_, size] = step.call();
                (step.value(&saw) + 0.5 * size * step.slope(&saw)) * size
            };
            assert!((schedule.map(impulse).sum::<f64>() - 1.35).abs() < 1e-8, "{step:?}");
        }
    }

    #[test]
    fn times_that_are_the_same_are_one_point() {
        // 3 · 0.1 is more than 0.3 by rounding, and 0.7 is hardly before the end
        let close = Table::straight(vec![0.3, 0.3, 0.3 + 1e-13, 0.3 + 1e-13], vec![0.0, 1.0, 1.0, 2.0], None);
        let found = ends(Schedule::new(0.7, Some(0.1), vec![0.25, 0.25, 0.7 - 1e-14], [&close]));
        assert_eq!(
            found.iter().map(|end| (end * 1e6).round()).collect::<Vec<_>>(),
            [1e5, 2e5, 2.5e5, 3e5, 4e5, 5e5, 6e5, 7e5]
        );
        assert_eq!(found.last(), Some(&0.7));
    }

    #[test]
    fn changes_are_due_before_the_step_that_begins_with_them() {
        let schedule = Schedule::new(1.0, Some(0.5), vec![0.0, 0.2, 0.2, 0.5 + 1e-12, 1.0], []);
        assert_eq!(schedule.map(|step| (step.end, step.due)).collect::<Vec<_>>(), [(0.2, 1), (0.5, 3), (1.0, 4)]);
    }

    #[test]
    fn without_a_step_points_of_tables_are_ends() {
        let table = Table::straight(vec![0.1, 0.4, 0.4, 2.0], vec![5.0, 20.0, -1.0, 0.0], None);
        assert_eq!(ends(Schedule::new(0.7, None, vec![0.6], [&table])), [0.1, 0.4, 0.6, 0.7]);
        let schedule = Schedule::new(0.7, None, Vec::new(), [&pulses(0.3)]);
        assert!(
            ends(schedule).iter().zip([0.15, 0.3, 0.45, 0.6, 0.7]).all(|(end, wanted)| (end - wanted).abs() < 1e-12)
        );
    }

    #[test]
    fn a_run_without_duration_has_no_step_and_one_shorter_than_its_step_has_one() {
        assert_eq!(ends(Schedule::new(0.0, Some(0.1), vec![0.0], [&pulses(0.1)])), []);
        assert_eq!(ends(Schedule::new(1e-6, Some(1e6), Vec::new(), [])), [1e-6]);
    }

    #[test]
    fn beginning_and_size_add_up_to_the_end() {
        for step in Schedule::new(1.0, Some(0.1), vec![1e-5, 0.7654321], []) {
            let [begin, size] = step.call();
            assert_eq!(begin + size, step.end);
        }
    }

    #[test]
    fn the_slope_of_a_step_that_a_jump_leaves_hardly_any_time_is_no_rounding_error() {
        for off in [1.5e-9, 2e-9, 2.0000001e-9, 2.5e-9, 1e-8] {
            for at in (1..10).map(|k| 0.1 * (f64::from(k) - off)) {
                let jump = Table::straight(vec![at, at, at + 1.0], vec![0.0, 1.0, 2.0], None);
                for step in Schedule::new(1.0, Some(0.1), Vec::new(), [&jump]) {
                    let slope = step.slope(&jump);
                    assert!(slope == 0.0 || (slope - 1.0).abs() < 1e-3, "{off} {at}: {step:?} {slope}");
                }
            }
        }
    }
}

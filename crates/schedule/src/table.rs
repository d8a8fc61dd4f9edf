//! Values over time: interpolated linearly or held, with jumps, once or repeated.

/// A value over time. It is constant before the first point and after the last one, or repeats.
#[derive(Clone, Debug)]
pub struct Table {
    /// Times [s] in ascending order; two equal ones are a jump.
    pub times: Vec<f64>,
    /// Values at these times.
    pub values: Vec<f64>,
    /// Time after which the table repeats [s]; `None` = the last value stays.
    pub period: Option<f64>,
    /// True if a value is held up to the next point, false if the table is linear between points.
    pub is_held: bool,
}

impl Table {
    /// Creates a table that is linear between `times` [s], which must not decrease, with a value for each time.
    pub fn straight(times: Vec<f64>, values: Vec<f64>, period: Option<f64>) -> Self {
        Self { times, values, period, is_held: false }
    }

    /// Value at `time` [s], just after a jump.
    pub fn at(&self, time: f64) -> f64 {
        let time = self.within_period(time);
        self.between(time, self.times.partition_point(|&t| t <= time))
    }

    /// Slope from just after `begin` to just before `end` [s], per second. There must be no jump between them.
    pub(crate) fn slope(&self, begin: f64, end: f64) -> f64 {
        (self.before(end) - self.at(begin)) / (end - begin)
    }

    /// Jumps of the table, or all its points if `points` is true. Jumps are two points at one time, and the end of a
    /// period whose last value differs from its first one.
    pub(crate) fn stops(&self, points: bool) -> Stops {
        let is_stop = |(i, time): &(usize, &f64)| points || self.times.get(i + 1) == Some(time);
        let inside = self.times.iter().enumerate().filter(is_stop).map(|(_, &time)| time);
        let at_end = self.period.filter(|&period| points || self.before(period) != self.at(0.0)).map(|_| 0.0);
        let end = self.period.unwrap_or(f64::INFINITY);
        let times = at_end.into_iter().chain(inside).filter(|time| (0.0..end).contains(time)).collect();
        Stops { times, period: self.period, passed: 0 }
    }

    /// Value at `time` [s], just before a jump.
    fn before(&self, time: f64) -> f64 {
        let within = self.within_period(time);
        // the end of a period, not the start of the next one
        let time = if within == 0.0 && time > 0.0 { self.period.unwrap_or(time) } else { within };
        self.between(time, self.times.partition_point(|&t| t < time))
    }

    fn within_period(&self, time: f64) -> f64 {
        self.period.map_or(time, |period| time.rem_euclid(period))
    }

    /// Value at `time` [s]; `after` is the index of the first point after it.
    fn between(&self, time: f64, after: usize) -> f64 {
        match (after.checked_sub(1), self.times.get(after)) {
            (None, _) => self.values[0],
            (Some(i), None) => self.values[i],
            (Some(i), Some(_)) if self.is_held => self.values[i],
            (Some(i), Some(&next)) if next == time => self.values[i + 1],
            (Some(i), Some(next)) => {
                let share = (time - self.times[i]) / (next - self.times[i]);
                self.values[i] + share * (self.values[i + 1] - self.values[i])
            }
        }
    }
}

/// Times at which steps end in addition to regular steps.
#[derive(Clone)]
pub(crate) struct Stops {
    /// Times [s] in ascending order, within the first period if they repeat.
    pub(crate) times: Vec<f64>,
    pub(crate) period: Option<f64>,
    /// Number of passed times.
    pub(crate) passed: usize,
}

impl Stops {
    /// The next time [s], or `None` if all times have passed.
    pub(crate) fn upcoming(&self) -> Option<f64> {
        let Some(period) = self.period else { return self.times.get(self.passed).copied() };
        let count = self.times.len();
        (count > 0).then(|| (self.passed / count) as f64 * period + self.times[self.passed % count])
    }

    /// Passes all times up to `time` [s].
    pub(crate) fn pass(&mut self, time: f64) {
        while self.upcoming().is_some_and(|next| next <= time) {
            self.passed += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(times: &[f64], values: &[f64], period: Option<f64>) -> Table {
        Table::straight(times.to_vec(), values.to_vec(), period)
    }

    fn first(table: &Table, count: usize) -> Vec<f64> {
        let mut jumps = table.stops(false);
        let mut found = Vec::new();
        while let Some(next) = jumps.upcoming().filter(|_| found.len() < count) {
            jumps.pass(next);
            found.push(next);
        }
        found
    }

    #[test]
    fn a_jump_comes_again_in_every_period() {
        let square = table(&[0.0, 1.0, 1.0, 3.0], &[1.0, 1.0, 0.0, 0.0], Some(3.0));
        assert_eq!(first(&square, 6), [0.0, 1.0, 3.0, 4.0, 6.0, 7.0]);
        // the last point is after the end of the period, and so is the second jump
        let cut = table(&[0.0, 1.0, 1.0, 4.0, 4.0], &[0.0, 1.0, 0.0, 0.0, 9.0], Some(2.0));
        assert_eq!(first(&cut, 3), [1.0, 3.0, 5.0]);
        // a period with equal first and last values
        let smooth = table(&[0.0, 0.1, 0.3], &[0.1, 0.7, 0.1], Some(0.3));
        assert!(first(&smooth, 1).is_empty());
        let once = table(&[0.0, 1.0, 1.0, 3.0], &[1.0, 1.0, 0.0, 0.0], None);
        assert_eq!(first(&once, 6), [1.0]);
    }

    #[test]
    fn slopes_connect_both_ends_of_a_step() {
        let given = table(&[0.0, 1.0, 3.0, 3.0, 4.0], &[0.0, 10.0, 10.0, 50.0, 20.0], Some(5.0));
        for (begin, end, slope) in [
            (0.0, 0.5, 10.0),
            // a kink
            (0.5, 1.5, 5.0),
            (1.0, 2.9, 0.0),
            // up to a jump, and after it in the next period
            (1.0, 3.0, 0.0),
            (8.0, 9.0, -30.0),
            // after the last point, up to the end of the period
            (4.0, 5.0, 0.0),
            (8.5, 10.0, -10.0),
        ] {
            assert!((given.slope(begin, end) - slope).abs() < 1e-12, "{begin} to {end}: {}", given.slope(begin, end));
        }
    }

    #[test]
    fn a_held_value_changes_at_its_points() {
        let held = Table { is_held: true, ..table(&[0.0, 1.0, 3.0], &[1.0, 2.0, 5.0], Some(4.0)) };
        assert_eq!(
            [0.0, 0.5, 1.0, 2.9, 3.0, 3.9, 4.0, 5.5].map(|time| held.at(time)),
            [1., 1., 2., 2., 5., 5., 1., 2.]
        );
        // the end of the period
        assert_eq!(first(&held, 2), [0.0, 4.0]);
    }
}

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
    /// Rule for the values between points.
    pub rule: Rule,
}

/// Rule for the values of a table between its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The table is linear between points, and the input follows it within a step. Steps end where its slope changes.
    Linear,
    /// The table is linear between points, but the value at the start of a step is held up to its end.
    Sampled,
    /// The value of a point is held up to the next point, and the value at the start of a step is held up to its end.
    Held,
}

impl Table {
    /// Creates a table that is linear between `times` [s], which must not decrease, with a value for each time.
    pub fn straight(times: Vec<f64>, values: Vec<f64>, period: Option<f64>) -> Self {
        Self { times, values, period, rule: Rule::Linear }
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

    /// Value at `time` [s], just before a jump.
    pub(crate) fn before(&self, time: f64) -> f64 {
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
            (Some(i), Some(_)) if self.rule == Rule::Held => self.values[i],
            (Some(i), Some(&next)) if next == time => self.values[i + 1],
            (Some(i), Some(next)) => {
                let share = (time - self.times[i]) / (next - self.times[i]);
                self.values[i] + share * (self.values[i + 1] - self.values[i])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(times: &[f64], values: &[f64], period: Option<f64>) -> Table {
        Table::straight(times.to_vec(), values.to_vec(), period)
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
        let held = Table { rule: Rule::Held, ..table(&[0.0, 1.0, 3.0], &[1.0, 2.0, 5.0], Some(4.0)) };
        assert_eq!(
            [0.0, 0.5, 1.0, 2.9, 3.0, 3.9, 4.0, 5.5].map(|time| held.at(time)),
            [1., 1., 2., 2., 5., 5., 1., 2.]
        );
    }
}

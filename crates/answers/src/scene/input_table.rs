//! Inputs that follow a table: straight from point to point, with jumps, once or again and again.

use bevel_differential::variables::Variable;

use super::units::six_digits;

/// Maximum number of jumps in a run. More of them are a mistake in the period.
const MOST_JUMPS: f64 = 1e8;

/// An input that goes straight from point to point.
#[derive(Clone)]
pub struct InputTable {
    /// The input.
    pub row: &'static Variable,
    /// Times [s], rising; two equal ones are a jump.
    pub times: Vec<f64>,
    /// Values there, in the unit of the interface.
    pub values: Vec<f64>,
    /// Time after which it repeats [s]; none = the last value stays.
    pub period: Option<f64>,
}

impl InputTable {
    /// Jumps of the value: two points of one time, and the end of a period whose next one begins with another value.
    pub fn jumps(&self) -> Jumps {
        let pairs = self.times.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]);
        let mut times: Vec<f64> = pairs.filter(|&time| self.period.is_none_or(|period| time < period)).collect();
        if self.period.is_some_and(|period| self.before(period) != self.at(0.0)) {
            times.insert(0, 0.0);
        }
        times.dedup();
        Jumps { times, period: self.period, place: 0, round: 0 }
    }

    /// Fails if the table jumps too often until `stop_time` [s].
    pub fn check(&self, stop_time: f64) -> Result<(), String> {
        let (Some(period), count) = (self.period, self.jumps().times.len()) else { return Ok(()) };
        if stop_time / period * count as f64 > MOST_JUMPS {
            return Err(format!(
                "{} jumps more than {MOST_JUMPS:e} times in {} s; its period is {period} s: give a longer one",
                self.row.name,
                six_digits(stop_time)
            ));
        }
        Ok(())
    }

    /// Slope over a step without jumps, from just after `begin` to just before `end` [s], per second.
    pub fn slope(&self, begin: f64, end: f64) -> f64 {
        (self.before(end) - self.at(begin)) / (end - begin)
    }

    /// Value at `time` [s], just after a jump.
    pub fn at(&self, time: f64) -> f64 {
        let time = self.within_period(time);
        self.between(time, self.times.partition_point(|&t| t <= time))
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

    /// Value at `time` [s], with `after` as the first point after it.
    fn between(&self, time: f64, after: usize) -> f64 {
        match (after.checked_sub(1), self.times.get(after)) {
            (None, _) => self.values[0],
            (Some(i), None) => self.values[i],
            (Some(i), Some(&next)) if next == time => self.values[i + 1],
            (Some(i), Some(next)) => {
                let share = (time - self.times[i]) / (next - self.times[i]);
                self.values[i] + share * (self.values[i + 1] - self.values[i])
            }
        }
    }
}

/// Times at which an input jumps, in every period.
#[derive(Clone)]
pub struct Jumps {
    /// Times of the jumps in the first period [s], rising.
    times: Vec<f64>,
    /// Period [s], if they repeat.
    period: Option<f64>,
    /// Position of the next one in `times`, and number of the period.
    place: usize,
    round: u64,
}

impl Jumps {
    /// Jumps at `times` [s], which rise and do not repeat.
    pub fn once(times: Vec<f64>) -> Self {
        Self { times, period: None, place: 0, round: 0 }
    }

    /// The next one [s].
    pub fn upcoming(&self) -> Option<f64> {
        let &time = self.times.get(self.place)?;
        Some(self.period.map_or(time, |period| self.round as f64 * period + time))
    }

    /// Passes those up to `time` [s].
    pub fn pass(&mut self, time: f64) {
        while self.upcoming().is_some_and(|next| next <= time) {
            self.place += 1;
            if self.place == self.times.len() && self.period.is_some() {
                (self.place, self.round) = (0, self.round + 1);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevel_differential::variables::named;

    fn table(times: &[f64], values: &[f64], period: Option<f64>) -> InputTable {
        let row = named("left.load_torque").expect("an input");
        InputTable { row, times: times.to_vec(), values: values.to_vec(), period }
    }

    fn first(table: &InputTable, count: usize) -> Vec<f64> {
        let mut jumps = table.jumps();
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
        // a period that begins as it ends
        let smooth = table(&[0.0, 0.1, 0.3], &[0.1, 0.7, 0.1], Some(0.3));
        assert!(first(&smooth, 1).is_empty());
        let once = table(&[0.0, 1.0, 1.0, 3.0], &[1.0, 1.0, 0.0, 0.0], None);
        assert_eq!(first(&once, 6), [1.0]);
    }

    #[test]
    fn slopes_are_those_between_both_ends_of_a_step() {
        let given = table(&[0.0, 1.0, 3.0, 3.0, 4.0], &[0.0, 10.0, 10.0, 50.0, 20.0], Some(5.0));
        for (begin, end, slope) in [
            (0.0, 0.5, 10.0),
            // a kink
            (0.5, 1.5, 5.0),
            (1.0, 2.9, 0.0),
            // up to a jump, and after it in the next round
            (1.0, 3.0, 0.0),
            (8.0, 9.0, -30.0),
            // after the last point, up to the end of the round
            (4.0, 5.0, 0.0),
            (8.5, 10.0, -10.0),
        ] {
            assert!((given.slope(begin, end) - slope).abs() < 1e-12, "{begin} to {end}: {}", given.slope(begin, end));
        }
    }

    #[test]
    fn a_period_with_countless_jumps_is_refused() {
        let square = |period: f64| table(&[0.0, 0.5 * period, 0.5 * period], &[1.0, 1.0, 0.0], Some(period));
        assert_eq!(square(1e-3).check(10.0), Ok(()));
        assert!(square(1e-9).check(10.0).is_err_and(|problem| problem.contains("left.load_torque jumps more than")));
    }
}

//! Times at which steps end beside the regular ones.

use crate::MOST;

/// Times that come once or in every period.
#[derive(Clone, Debug)]
pub(crate) struct Stops {
    /// Times in the first period [s], rising.
    times: Vec<f64>,
    /// Period [s], if they repeat.
    period: Option<f64>,
    /// Position of the next one in `times`, and number of the period.
    place: usize,
    round: u64,
}

impl Stops {
    /// Stops at `times` [s], which do not fall.
    pub(crate) fn new(times: impl IntoIterator<Item = f64>, period: Option<f64>) -> Self {
        let mut times = Vec::from_iter(times);
        times.dedup();
        Self { times, period, place: 0, round: 0 }
    }

    /// The next one [s].
    pub(crate) fn upcoming(&self) -> Option<f64> {
        let &time = self.times.get(self.place)?;
        Some(self.period.map_or(time, |period| self.round as f64 * period + time))
    }

    /// Passes those up to `time` [s].
    pub(crate) fn pass(&mut self, time: f64) {
        while self.upcoming().is_some_and(|next| next <= time) {
            self.place += 1;
            if self.place == self.times.len() && self.period.is_some() {
                (self.place, self.round) = (0, self.round + 1);
            }
        }
    }

    /// Returns true if there are more than `MOST` until `stop` [s].
    pub(crate) fn are_countless(&self, stop: f64) -> bool {
        self.period.is_some_and(|period| stop / period * self.times.len() as f64 > MOST)
    }
}

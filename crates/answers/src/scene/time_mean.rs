//! Mean over time of a record, which is linear between its rows. The second row of a jump has the same time.

/// Mean over time by the trapezoidal rule, row by row.
#[derive(Clone, Copy, Debug, Default)]
pub struct TimeMean {
    /// Integral over time so far, in the unit of the values times s.
    integral: f64,
    /// Time so far [s].
    span: f64,
    /// Time [s] and value of the last row.
    last: Option<(f64, f64)>,
}

impl TimeMean {
    /// Mean of `values` at `times` [s]; 0 without values.
    pub fn of(times: &[f64], values: impl Iterator<Item = f64>) -> f64 {
        let mut mean = Self::default();
        times.iter().zip(values).for_each(|(&time, value)| mean.add(time, value));
        mean.value()
    }

    /// Adds a row with its `time` [s].
    pub fn add(&mut self, time: f64, value: f64) {
        if let Some((before, last)) = self.last {
            self.integral += 0.5 * (time - before) * (last + value);
            self.span += time - before;
        }
        self.last = Some((time, value));
    }

    /// Mean so far. Without duration, it is the last value.
    pub fn value(&self) -> f64 {
        if self.span > 0.0 { self.integral / self.span } else { self.last.map_or(0.0, |(_, value)| value) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_lines_and_jumps_is_exact_on_uneven_rows() {
        // 100 up to a jump at 0.5 s, then 0; then a line to 8
        let mean = TimeMean::of(&[0.0, 0.1, 0.5, 0.5, 0.75, 1.0], [100.0, 100.0, 100.0, 0.0, 0.0, 8.0].into_iter());
        assert!((mean - 51.0).abs() < 1e-12, "{mean}");
        assert_eq!(TimeMean::of(&[0.0, 0.0], [1.0, 3.0].into_iter()), 3.0);
        assert_eq!(TimeMean::of(&[], [].into_iter()), 0.0);
    }
}

//! Times on the processor, and what is made of repeated ones.
//!
//! Jobs are run in turn, each once in a round, so that what else the machine does hits all alike. A number is the median
//! of its runs with the quartiles around it.

use std::path::Path;
use std::{env, fs, thread};

use cpu_time::ThreadTime;

/// Runs shorter than this are repeated until they are as long together [s]; clocks of processors are coarser than that.
const SHORTEST: f64 = 2e-3;
/// Runs longer than this are made only [`FEWEST`] times [s].
const LONG: f64 = 0.2;
/// Fewest runs of a job.
const FEWEST: usize = 5;

/// Median and quartiles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Median.
    pub median: f64,
    /// Lower quartile.
    pub low: f64,
    /// Upper quartile.
    pub high: f64,
    /// How many values there were.
    pub count: usize,
}

impl Spread {
    /// That of `values`; numbers that are not, if there are none.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |part: f64| {
            let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
            let place = part * last as f64;
            let (below, rest) = (place.floor() as usize, place.fract());
            sorted[below] + rest * (sorted[(below + 1).min(last)] - sorted[below])
        };
        Self { median: at(0.5), low: at(0.25), high: at(0.75), count: sorted.len() }
    }

    /// Its cells: median, quartiles, count.
    pub fn cells(&self) -> [String; 4] {
        let [median, low, high] = [self.median, self.low, self.high].map(number);
        [median, low, high, self.count.to_string()]
    }
}

/// Something whose time is measured.
pub struct Job<'a> {
    /// Does it once.
    pub run: Box<dyn FnMut() + 'a>,
    /// Seconds it took when it was done before.
    pub first: f64,
}

/// Times `jobs` in `rounds` rounds, long ones in fewer. `tell` hears how much of the work is done, a fraction.
pub fn time(jobs: &mut [Job], rounds: usize, tell: &mut dyn FnMut(f64)) -> Vec<Spread> {
    let rounds = rounds.max(FEWEST);
    let is_due = |job: &Job, round: usize| job.first < LONG || round < FEWEST;
    let all: f64 = (0..rounds)
        .flat_map(|round| jobs.iter().map(move |job| (round, job.first, is_due(job, round))))
        .map(|(_, first, due)| if due { first.max(SHORTEST) } else { 0.0 })
        .sum();
    let mut done = 0.0;
    let mut seconds = vec![Vec::new(); jobs.len()];
    for round in 0..rounds {
        for (job, seconds) in jobs.iter_mut().zip(&mut seconds) {
            if !is_due(job, round) {
                continue;
            }
            let begun = ThreadTime::now();
            let mut times = 0.0;
            while times == 0.0 || begun.elapsed().as_secs_f64() < SHORTEST {
                (job.run)();
                times += 1.0;
            }
            seconds.push(begun.elapsed().as_secs_f64() / times);
            done += job.first.max(SHORTEST);
            tell(done / all);
        }
    }
    seconds.iter().map(|seconds| Spread::of(seconds)).collect()
}

/// Largest difference of two series over `scale`.
pub fn largest_error(values: impl Iterator<Item = (f64, f64)>, scale: f64) -> f64 {
    // max() passes over NaN, a sum does not
    let (largest, sum) = values.fold((0.0f64, 0.0), |(largest, sum), (a, b)| {
        let error = (a - b).abs();
        (largest.max(error), sum + error)
    });
    if sum.is_finite() { largest / scale } else { f64::NAN }
}

/// A number as it stands in a CSV file.
pub fn number(value: f64) -> String {
    if value.is_nan() { "nan".into() } else { format!("{value:.6e}") }
}

/// Processor, cores and system, in a line.
pub fn machine() -> String {
    let info = fs::read_to_string(Path::new("/proc/cpuinfo")).unwrap_or_default();
    let field = |name: &str| {
        let line = info.lines().find(|line| line.starts_with(name))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let processor = field("model name").or_else(|| field("Model")).unwrap_or_else(|| "processor not named".into());
    let cores = thread::available_parallelism().map_or(1, |cores| cores.get());
    format!("{processor}, {cores} cores, {} {}", env::consts::OS, env::consts::ARCH)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_lie_between_the_values_they_part() {
        let spread = Spread::of(&[5.0, 1.0, 2.0, 4.0, 3.0]);
        assert_eq!(spread, Spread { median: 3.0, low: 2.0, high: 4.0, count: 5 });
        assert_eq!(Spread::of(&[1.0, 2.0]).median, 1.5);
        assert!(Spread::of(&[]).median.is_nan());
    }

    #[test]
    fn an_error_is_the_largest_difference_and_no_number_stays_none() {
        assert_eq!(largest_error([(1.0, 1.5), (3.0, 2.0)].into_iter(), 4.0), 0.25);
        assert!(largest_error([(1.0, f64::NAN), (3.0, 2.0)].into_iter(), 4.0).is_nan());
    }

    #[test]
    fn long_jobs_run_less_often_than_short_ones_and_at_least_five_times() {
        let counts = [0, 1].map(std::cell::Cell::new);
        let job = |i: usize, first: f64| {
            let count = &counts[i];
            Job { run: Box::new(move || count.set(count.get() + 1)), first }
        };
        let mut told = 0.0;
        let spreads = time(&mut [job(0, 0.0), job(1, 1.0)], 7, &mut |done| told = done);
        assert_eq!(spreads.iter().map(|s| s.count).collect::<Vec<_>>(), [7, 5]);
        assert!(counts[0].get() > counts[1].get() && told > 0.999);
    }
}

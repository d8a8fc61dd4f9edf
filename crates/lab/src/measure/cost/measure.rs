//! Times on the processor, from repeated runs.
//!
//! Jobs are run in turn, each once in a round, so that other load of the machine affects all alike. A number is the median
//! of its runs with the quartiles around it.

use cpu_time::ThreadTime;

use answers::text::csv_file::number;
use answers::text::numbers::Spread;

/// Runs shorter than this are repeated until they are as long together [s]; clocks of processors are coarser than that.
const SHORTEST: f64 = 2e-3;
/// Runs longer than this are made only [`FEWEST`] times [s].
const LONG: f64 = 0.2;
/// Fewest runs of a job.
const FEWEST: usize = 5;

/// Cells of a spread: median, quartiles, count.
pub fn cells(spread: &Spread) -> [String; 4] {
    let [median, low, high] = [spread.median, spread.low, spread.high].map(number);
    [median, low, high, spread.count.to_string()]
}

/// Something whose time is measured.
pub struct TimedJob<'a> {
    /// Does it once.
    pub run: Box<dyn FnMut() + 'a>,
    /// Seconds it took when it was done before.
    pub first: f64,
}

/// Times `jobs` in `rounds` rounds, long ones in fewer. `report` receives the fraction done.
pub fn time(jobs: &mut [TimedJob], rounds: usize, report: &mut dyn FnMut(f64)) -> Vec<Spread> {
    let rounds = rounds.max(FEWEST);
    let is_due = |job: &TimedJob, round: usize| job.first < LONG || round < FEWEST;
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
            report(done / all);
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

#[cfg(test)]
mod tests {
    use super::*;

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
            TimedJob { run: Box::new(move || count.set(count.get() + 1)), first }
        };
        let mut last = 0.0;
        let spreads = time(&mut [job(0, 0.0), job(1, 1.0)], 7, &mut |done| last = done);
        assert_eq!(spreads.iter().map(|s| s.count).collect::<Vec<_>>(), [7, 5]);
        assert!(counts[0].get() > counts[1].get() && last > 0.999);
    }
}

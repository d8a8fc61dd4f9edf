//! Progress on the terminal; without a terminal, one line per stage. For work in several steps, the number of the step,
//! the completed share and the approximate remaining time are shown.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};

/// Redraw interval of the display.
const TICK: Duration = Duration::from_millis(100);
/// Number of positions of the bar.
const BAR_LENGTH: u64 = 1000;
/// Maximum completed fraction of the present step. A step that takes longer than expected remains incomplete.
const MAX_STEP_FRACTION: f64 = 0.95;
/// Weight of the expected pace, as a share of the whole work. The measured pace outweighs it once this share is done.
const EXPECTED_WEIGHT: f64 = 0.1;

/// Present display, which notes must not overwrite.
static SHOWN: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Spinner, with a bar as soon as a fraction is known.
pub struct Progress {
    bar: ProgressBar,
    steps: Option<Arc<Mutex<Steps>>>,
}

impl Progress {
    /// Starts the display with a first stage.
    pub fn start(stage: &str) -> Self {
        let progress = Self::new(None);
        progress.style("{spinner} {msg}");
        progress.stage(stage);
        progress
    }

    /// Starts work in steps, whose durations are `expected` on a machine with two cores [s].
    pub fn of_steps(expected: Vec<f64>) -> Self {
        let progress = Self::new(Some(Arc::new(Mutex::new(Steps::new(expected)))));
        progress.style("{spinner} {place}, {msg}, {left}");
        progress
    }

    fn new(steps: Option<Arc<Mutex<Steps>>>) -> Self {
        let bar = ProgressBar::new(BAR_LENGTH);
        bar.enable_steady_tick(TICK);
        *held(&SHOWN) = Some(bar.clone());
        Self { bar, steps }
    }

    /// Begins the next step.
    pub fn step(&self, what: &str) {
        if let Some(steps) = &self.steps {
            held(steps).begin();
        }
        self.stage(what);
    }

    /// Begins the next stage, within the present step if there are steps.
    pub fn stage(&self, stage: &str) {
        if self.bar.is_hidden() {
            match self.steps.as_deref().map(held) {
                Some(steps) => eprintln!("{}, {stage}, {}", steps.place(), steps.left()),
                None => eprintln!("{stage}"),
            }
        }
        self.bar.set_message(stage.to_owned());
    }

    /// Begins a stage of known length.
    pub fn begin_bar(&self, stage: &str) {
        if self.steps.is_none() {
            self.style("{spinner} [{bar:40}] {percent:>3} % {msg}");
        }
        self.stage(stage);
    }

    /// Shows the completed fraction of the step, or of the stage if there are no steps, from 0 to 1.
    pub fn advance(&self, fraction: f64, what: &str) {
        match &self.steps {
            Some(steps) => held(steps).fraction = Some(fraction.clamp(0.0, 1.0)),
            None => self.bar.set_position((fraction.clamp(0.0, 1.0) * BAR_LENGTH as f64) as u64),
        }
        self.bar.set_message(what.to_owned());
    }

    /// Ends the display.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
        *held(&SHOWN) = None;
    }

    fn style(&self, template: &str) {
        // a template that does not parse only changes the appearance
        let Ok(mut style) = ProgressStyle::with_template(template) else { return };
        if let Some(steps) = &self.steps {
            type Shown = fn(&Steps) -> String;
            for (key, shown) in [("place", Steps::place as Shown), ("left", Steps::left)] {
                let steps = Arc::clone(steps);
                style = style.with_key(key, move |_: &ProgressState, out: &mut dyn std::fmt::Write| {
                    let _ = out.write_str(&shown(&held(&steps)));
                });
            }
        }
        self.bar.set_style(style.progress_chars("=> "));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.finish();
    }
}

/// Prints a remark above the display.
pub fn note(text: &str) {
    match &*held(&SHOWN) {
        Some(bar) => bar.suspend(|| eprintln!("{text}")),
        None => eprintln!("{text}"),
    }
}

/// Locks the mutex. A failed thread leaves no inconsistent data here.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Progress of work in steps.
struct Steps {
    /// Expected duration of each step [s].
    expected: Vec<f64>,
    /// Number of steps that have begun.
    begun: usize,
    /// Completed fraction of the present step, if it is known.
    fraction: Option<f64>,
    start: Instant,
    start_of_step: Instant,
}

impl Steps {
    fn new(expected: Vec<f64>) -> Self {
        let now = Instant::now();
        Self { expected, begun: 0, fraction: None, start: now, start_of_step: now }
    }

    fn begin(&mut self) {
        (self.begun, self.fraction, self.start_of_step) = (self.begun + 1, None, Instant::now());
    }

    /// Position as text: "2 of 6 (40 %)".
    fn place(&self) -> String {
        format!("{} of {} ({:.0} %)", self.begun, self.expected.len(), 100.0 * self.share())
    }

    /// Remaining time as text: "about 20 s left".
    fn left(&self) -> String {
        let total = self.expected.iter().sum();
        let seconds = time_left(total, self.share(), self.start.elapsed().as_secs_f64());
        if seconds < 1.5 { "almost done".to_owned() } else { format!("about {seconds:.0} s left") }
    }

    /// Completed share of the whole work. The fraction of the present step is the reported one. If none was reported, it
    /// is the elapsed share of the expected duration.
    fn share(&self) -> f64 {
        let Some(at) = self.begun.checked_sub(1).filter(|&at| at < self.expected.len()) else { return 0.0 };
        let by_clock = || self.start_of_step.elapsed().as_secs_f64() / self.expected[at];
        let done = self.expected[at] * self.fraction.unwrap_or_else(by_clock).min(MAX_STEP_FRACTION);
        (self.expected[..at].iter().sum::<f64>() + done) / self.expected.iter().sum::<f64>()
    }
}

/// Estimates the remaining time [s] of work whose expected time is `total`, if a `share` of it took the time `elapsed`.
/// The estimate starts with the expected pace and moves to the measured one.
fn time_left(total: f64, share: f64, elapsed: f64) -> f64 {
    let pace = (elapsed + EXPECTED_WEIGHT * total) / ((share + EXPECTED_WEIGHT) * total);
    (1.0 - share) * total * pace
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_remaining_time_moves_from_the_expected_to_the_measured_pace() {
        assert_eq!(time_left(60.0, 0.0, 0.0), 60.0);
        // as expected
        assert!((time_left(60.0, 0.5, 30.0) - 30.0).abs() < 1e-9);
        // twice as slow as expected
        let left = time_left(60.0, 0.5, 60.0);
        assert!(left > 50.0 && left < 60.0, "{left}");
    }

    #[test]
    fn steps_show_their_number_their_share_and_the_remaining_time() {
        let mut steps = Steps::new(vec![30.0, 10.0]);
        steps.begin();
        steps.fraction = Some(0.5);
        assert_eq!(steps.place(), "1 of 2 (38 %)");
        steps.begin();
        steps.fraction = Some(0.0);
        assert_eq!(steps.place(), "2 of 2 (75 %)");
        // the steps took no time
        assert_eq!(steps.left(), "almost done");
        steps.start -= Duration::from_secs(60);
        assert_eq!(steps.left(), "about 19 s left");
    }
}

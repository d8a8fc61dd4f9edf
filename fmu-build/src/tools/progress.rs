//! Progress on the terminal; without a terminal, a line per stage. Work in several steps tells the step, the share of the whole and
//! about how long the rest takes.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};

/// Redraw interval of the spinner.
const TICK: Duration = Duration::from_millis(100);
/// Resolution of the bar.
const FULL: u64 = 1000;
/// A step that takes longer than expected is not taken for done.
const ALMOST: f64 = 0.95;
/// Share of the whole from which on the pace counts that was found, and not the one expected.
const FIRST: f64 = 0.1;

/// What is shown at present, for notes beside it.
static SHOWN: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// A spinner, and a bar once a fraction is known.
pub struct Progress {
    bar: ProgressBar,
    steps: Option<Arc<Mutex<Steps>>>,
}

impl Progress {
    /// Starts with a first stage.
    pub fn start(stage: &str) -> Self {
        let progress = Self::shown(None);
        progress.style("{spinner} {msg}");
        progress.stage(stage);
        progress
    }

    /// Starts work of so many seconds in each step, as expected on a machine of two cores.
    pub fn of_steps(expected: Vec<f64>) -> Self {
        let progress = Self::shown(Some(Arc::new(Mutex::new(Steps::new(expected)))));
        progress.style("{spinner} {place}, {msg}, {left}");
        progress
    }

    fn shown(steps: Option<Arc<Mutex<Steps>>>) -> Self {
        let bar = ProgressBar::new(FULL);
        bar.enable_steady_tick(TICK);
        *held(&SHOWN) = Some(bar.clone());
        Self { bar, steps }
    }

    /// The next step begins.
    pub fn step(&self, what: &str) {
        if let Some(steps) = &self.steps {
            held(steps).begin();
        }
        self.stage(what);
    }

    /// Next stage, of the present step if there are steps.
    pub fn stage(&self, stage: &str) {
        if self.bar.is_hidden() {
            match self.steps.as_deref().map(held) {
                Some(steps) => eprintln!("{}, {stage}, {}", steps.place(), steps.left()),
                None => eprintln!("{stage}"),
            }
        }
        self.bar.set_message(stage.to_owned());
    }

    /// A stage of known length begins.
    pub fn begin_bar(&self, stage: &str) {
        if self.steps.is_none() {
            self.style("{spinner} [{bar:40}] {percent:>3} % {msg}");
        }
        self.stage(stage);
    }

    /// A part of the stage is done: `fraction` from 0 to 1.
    pub fn advance(&self, fraction: f64, what: &str) {
        match &self.steps {
            Some(steps) => held(steps).fraction = Some(fraction.clamp(0.0, 1.0)),
            None => self.bar.set_position((fraction.clamp(0.0, 1.0) * FULL as f64) as u64),
        }
        self.bar.set_message(what.to_owned());
    }

    /// Ends the display.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
        *held(&SHOWN) = None;
    }

    fn style(&self, template: &str) {
        // a template that does not parse only changes the looks
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

/// Prints a remark above what is shown.
pub fn note(text: &str) {
    match &*held(&SHOWN) {
        Some(bar) => bar.suspend(|| eprintln!("{text}")),
        None => eprintln!("{text}"),
    }
}

/// What the mutex holds; a thread that failed leaves nothing half done here.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Work in steps, and how far it is.
struct Steps {
    /// Time that each step is expected to take [s].
    expected: Vec<f64>,
    /// Steps that have begun.
    begun: usize,
    /// Part of the present step that is done, where it is known.
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

    /// "2 of 6 (40 %)".
    fn place(&self) -> String {
        format!("{} of {} ({:.0} %)", self.begun, self.expected.len(), 100.0 * self.share())
    }

    /// "about 20 s left".
    fn left(&self) -> String {
        let total = self.expected.iter().sum();
        let seconds = time_left(total, self.share(), self.start.elapsed().as_secs_f64());
        if seconds < 1.5 { "almost done".to_owned() } else { format!("about {seconds:.0} s left") }
    }

    /// Share of the whole that is done: of the present step as told, or by the clock.
    fn share(&self) -> f64 {
        let Some(at) = self.begun.checked_sub(1).filter(|&at| at < self.expected.len()) else { return 0.0 };
        let by_clock = || self.start_of_step.elapsed().as_secs_f64() / self.expected[at];
        let done = self.expected[at] * self.fraction.unwrap_or_else(by_clock).min(ALMOST);
        (self.expected[..at].iter().sum::<f64>() + done) / self.expected.iter().sum::<f64>()
    }
}

/// Time that the rest of work takes [s], of which `total` was expected and a `share` took the time `elapsed`: at the pace expected
/// first, and more and more at that found.
fn time_left(total: f64, share: f64, elapsed: f64) -> f64 {
    let pace = (elapsed + FIRST * total) / ((share + FIRST) * total);
    (1.0 - share) * total * pace
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_takes_what_was_expected_at_first_and_later_what_the_pace_says() {
        assert_eq!(time_left(60.0, 0.0, 0.0), 60.0);
        // as expected
        assert!((time_left(60.0, 0.5, 30.0) - 30.0).abs() < 1e-9);
        // twice as slow as expected
        let left = time_left(60.0, 0.5, 60.0);
        assert!(left > 50.0 && left < 60.0, "{left}");
    }

    #[test]
    fn steps_tell_their_number_their_share_and_the_rest() {
        let mut steps = Steps::new(vec![30.0, 10.0]);
        steps.begin();
        steps.fraction = Some(0.5);
        assert_eq!(steps.place(), "1 of 2 (38 %)");
        steps.begin();
        steps.fraction = Some(0.0);
        assert_eq!(steps.place(), "2 of 2 (75 %)");
        // nothing took any time
        assert_eq!(steps.left(), "almost done");
        steps.start -= Duration::from_secs(60);
        assert_eq!(steps.left(), "about 19 s left");
    }
}

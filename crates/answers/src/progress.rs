//! Progress of the work on an answer, and warnings about the question. The waiting caller receives both and may stop
//! the work.

use std::fmt;
use std::time::{Duration, Instant};

/// Minimum interval between two reports, except those of [`Progress::begin_task`].
const REPORT_INTERVAL: Duration = Duration::from_millis(50);

/// Receives the completed fraction of the work, from 0 to 1, and the name of the present task. Returns true to
/// continue.
type Report<'a> = Box<dyn FnMut(f64, &str) -> bool + 'a>;

/// Reports progress to the caller. After the caller has stopped the work, every check fails.
pub struct Progress<'a> {
    report: Report<'a>,
    /// Completed fraction of the work, from 0 to 1.
    done: f64,
    /// Name of the present task.
    task: String,
    /// Time of the last report; `None` before the first one.
    asked: Option<Instant>,
    /// True if the caller stopped the work.
    stopped: bool,
    /// Warnings about the question, without repetitions.
    warnings: Vec<String>,
}

/// The caller stopped the work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopped;

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("stopped before the end")
    }
}

impl std::error::Error for Stopped {}

impl<'a> Progress<'a> {
    /// Creates a progress that calls `report` with the completed fraction of the work, from 0 to 1, and the name of the
    /// present task. `report` returns true to continue.
    pub fn new(report: impl FnMut(f64, &str) -> bool + 'a) -> Self {
        Self {
            report: Box::new(report),
            done: 0.0,
            task: String::new(),
            asked: None,
            stopped: false,
            warnings: Vec::new(),
        }
    }

    /// Creates a progress that reports nothing and never stops the work.
    pub fn silent() -> Self {
        Self::new(|_, _| true)
    }

    /// Reports a new `task` immediately, unless the work is stopped.
    pub fn begin_task(&mut self, done: f64, task: &str) {
        self.done = done;
        task.clone_into(&mut self.task);
        self.ask();
    }

    /// Reports the completed fraction, at most once every `REPORT_INTERVAL`. Fails if the work is stopped.
    pub fn advance(&mut self, done: f64) -> Result<(), Stopped> {
        self.done = done;
        self.check_stopped()
    }

    /// Fails if the work is stopped. Calls `report` at most once every `REPORT_INTERVAL`.
    pub fn check_stopped(&mut self) -> Result<(), Stopped> {
        if self.asked.is_none_or(|asked| asked.elapsed() > REPORT_INTERVAL) {
            self.ask();
        }
        if self.stopped { Err(Stopped) } else { Ok(()) }
    }

    /// Adds warnings to the answer, without repeating a text.
    pub fn warn(&mut self, warnings: impl IntoIterator<Item = impl fmt::Display>) {
        for text in warnings.into_iter().map(|warning| warning.to_string()) {
            if !self.warnings.contains(&text) {
                self.warnings.push(text);
            }
        }
    }

    /// Warnings so far.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn ask(&mut self) {
        self.asked = Some(Instant::now());
        self.stopped = self.stopped || !(self.report)(self.done, &self.task);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repeated_warning_is_kept_once() {
        let mut progress = Progress::silent();
        progress.warn(["b", "a"]);
        progress.warn(["a", "c"]);
        assert_eq!(progress.warnings(), ["b", "a", "c"]);
    }

    #[test]
    fn stopped_work_stays_stopped() {
        let mut calls = 0;
        let mut progress = Progress::new(|_, _| {
            calls += 1;
            calls != 2
        });
        assert_eq!(progress.check_stopped(), Ok(()));
        progress.begin_task(0.5, "half");
        assert_eq!([progress.check_stopped(), progress.advance(0.6)], [Err(Stopped), Err(Stopped)]);
        progress.begin_task(0.7, "more");
        assert_eq!(progress.check_stopped(), Err(Stopped));
        drop(progress);
        assert_eq!(calls, 2);
    }
}

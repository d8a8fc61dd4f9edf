//! Progress of the work on an answer, for the caller that waits for it, and warnings about what the question asks. The caller may
//! stop the work.

use std::fmt;
use std::time::{Duration, Instant};

/// Least interval between two calls of the caller, except by [`Progress::begin_task`].
const REPORT_INTERVAL: Duration = Duration::from_millis(50);

/// Takes the part of the work that is done, from 0 to 1, and the name of the present task. Returns whether to go on.
type Report<'a> = Box<dyn FnMut(f64, &str) -> bool + 'a>;

/// Reports progress to the caller and remembers whether the caller stopped the work.
pub struct Progress<'a> {
    report: Report<'a>,
    done: f64,
    task: String,
    asked: Option<Instant>,
    stopped: bool,
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
    /// `report` takes the part of the work that is done, from 0 to 1, and the name of the present task. It returns whether to go
    /// on.
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

    /// No caller: nothing is reported, and the work is never stopped.
    pub fn silent() -> Self {
        Self::new(|_, _| true)
    }

    /// Reports a new `task` at once, unless the work is stopped.
    pub fn begin_task(&mut self, done: f64, task: &str) {
        self.done = done;
        task.clone_into(&mut self.task);
        self.ask();
    }

    /// Reports the part that is done, at most once every `REPORT_INTERVAL`. Fails if the work is stopped.
    pub fn advance(&mut self, done: f64) -> Result<(), Stopped> {
        self.done = done;
        self.check_stopped()
    }

    /// Fails if the work is stopped. Asks the caller at most once every `REPORT_INTERVAL`.
    pub fn check_stopped(&mut self) -> Result<(), Stopped> {
        if self.asked.is_none_or(|asked| asked.elapsed() > REPORT_INTERVAL) {
            self.ask();
        }
        if self.stopped { Err(Stopped) } else { Ok(()) }
    }

    /// Adds warnings to the answer, each text once.
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
    fn each_warning_is_kept_once() {
        let mut progress = Progress::silent();
        progress.warn(["b", "a"]);
        progress.warn(["a", "c"]);
        assert_eq!(progress.warnings(), ["b", "a", "c"]);
    }

    #[test]
    fn work_that_was_stopped_stays_so() {
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

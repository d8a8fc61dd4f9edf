//! Progress of the work on an answer, for the caller that waits for it. The caller may stop the work.

use std::fmt;
use std::time::{Duration, Instant};

/// Least interval between two calls of the caller, except by [`Watch::say`].
const OFTEN: Duration = Duration::from_millis(50);

/// Takes the part of the work that is done, from 0 to 1, and the name of the present task. Returns whether to go on.
type Tell<'a> = Box<dyn FnMut(f64, &str) -> bool + 'a>;

/// Reports progress to the caller and remembers whether the caller stopped the work.
pub struct Watch<'a> {
    tell: Tell<'a>,
    done: f64,
    what: String,
    asked: Option<Instant>,
    stopped: bool,
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

impl<'a> Watch<'a> {
    /// `tell` takes the part of the work that is done, from 0 to 1, and the name of the present task. It returns whether to go
    /// on.
    pub fn new(tell: impl FnMut(f64, &str) -> bool + 'a) -> Self {
        Self { tell: Box::new(tell), done: 0.0, what: String::new(), asked: None, stopped: false }
    }

    /// No caller: nothing is reported, and the work is never stopped.
    pub fn nobody() -> Self {
        Self::new(|_, _| true)
    }

    /// Reports a new task `what` at once, unless the work is stopped.
    pub fn say(&mut self, done: f64, what: &str) {
        self.done = done;
        what.clone_into(&mut self.what);
        self.ask();
    }

    /// Reports the part that is done, at most once every `OFTEN`. Fails if the work is stopped.
    pub fn advance(&mut self, done: f64) -> Result<(), Stopped> {
        self.done = done;
        self.go_on()
    }

    /// Fails if the work is stopped. Asks the caller at most once every `OFTEN`.
    pub fn go_on(&mut self) -> Result<(), Stopped> {
        if self.asked.is_none_or(|asked| asked.elapsed() > OFTEN) {
            self.ask();
        }
        if self.stopped { Err(Stopped) } else { Ok(()) }
    }

    fn ask(&mut self) {
        self.asked = Some(Instant::now());
        self.stopped = self.stopped || !(self.tell)(self.done, &self.what);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_that_was_stopped_stays_so() {
        let mut calls = 0;
        let mut watch = Watch::new(|_, _| {
            calls += 1;
            calls != 2
        });
        assert_eq!(watch.go_on(), Ok(()));
        watch.say(0.5, "half");
        assert_eq!([watch.go_on(), watch.advance(0.6)], [Err(Stopped), Err(Stopped)]);
        watch.say(0.7, "more");
        assert_eq!(watch.go_on(), Err(Stopped));
        drop(watch);
        assert_eq!(calls, 2);
    }
}

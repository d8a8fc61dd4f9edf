//! Who waits for an answer: is told how far the work is, and may stop it.

use std::fmt;
use std::time::{Duration, Instant};

/// Between two communication points of a run whoever waits is asked this often.
const OFTEN: Duration = Duration::from_millis(50);

/// Is given the part of the work that is done and what is being done; says whether to go on.
type Tell<'a> = Box<dyn FnMut(f64, &str) -> bool + 'a>;

/// Whoever waits.
pub struct Watch<'a> {
    tell: Tell<'a>,
    done: f64,
    what: String,
    asked: Option<Instant>,
    stopped: bool,
}

/// The work was stopped by whoever waited for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopped;

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("stopped before the end")
    }
}

impl std::error::Error for Stopped {}

impl<'a> Watch<'a> {
    /// `tell` is given the part of the work that is done, from 0 to 1, and what is being done. It returns whether to go on.
    pub fn new(tell: impl FnMut(f64, &str) -> bool + 'a) -> Self {
        Self { tell: Box::new(tell), done: 0.0, what: String::new(), asked: None, stopped: false }
    }

    /// Nobody who would stop it.
    pub fn nobody() -> Self {
        Self::new(|_, _| true)
    }

    /// Says what is done now, unless the work is stopped.
    pub fn say(&mut self, done: f64, what: &str) {
        self.done = done;
        what.clone_into(&mut self.what);
        self.ask();
    }

    /// Says how far it is; more often than can be read it says nothing.
    pub fn advance(&mut self, done: f64) -> Result<(), Stopped> {
        self.done = done;
        self.go_on()
    }

    /// Whether to go on.
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

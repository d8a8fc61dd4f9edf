//! Progress on the terminal; without a terminal, a line per stage.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// Redraw interval of the spinner.
const TICK: Duration = Duration::from_millis(100);
/// Resolution of the bar.
const FULL: u64 = 1000;

/// A spinner, and a bar once a fraction is known.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// Starts with a first stage.
    pub fn start(stage: &str) -> Self {
        let progress = Self { bar: ProgressBar::new(FULL) };
        progress.style("{spinner} {msg}");
        progress.bar.enable_steady_tick(TICK);
        progress.stage(stage);
        progress
    }

    /// Next stage.
    pub fn stage(&self, stage: &str) {
        if self.bar.is_hidden() {
            eprintln!("{stage}");
        }
        self.bar.set_message(stage.to_owned());
    }

    /// A stage of known length begins.
    pub fn begin_bar(&self, stage: &str) {
        self.style("{spinner} [{bar:40}] {percent:>3} % {msg}");
        self.stage(stage);
    }

    /// A part of the stage is done: `fraction` from 0 to 1.
    pub fn advance(&self, fraction: f64, what: &str) {
        self.bar.set_position((fraction.clamp(0.0, 1.0) * FULL as f64) as u64);
        self.bar.set_message(what.to_owned());
    }

    /// Ends the display.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn style(&self, template: &str) {
        // a template that does not parse only changes the looks
        if let Ok(style) = ProgressStyle::with_template(template) {
            self.bar.set_style(style.progress_chars("=> "));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.finish();
    }
}

//! Execution of programs with progress display.

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::thread;

use anyhow::{Context, Result, bail};

use crate::tools::program::{FINDING, Finding};
use crate::tools::progress::Progress;

/// Runs `command` to its end and returns its standard output. Lines "progress <fraction> <what>" on standard error move
/// the bar. If the command fails, the error consists of `name` and the other lines on standard error. The error is a
/// [`Finding`] if the exit status says so.
pub fn follow(command: &mut Command, name: &str, progress: &Progress) -> Result<String> {
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .with_context(|| format!("{name} cannot be run"))?;
    // both pipes are read at the same time, so that neither fills up
    let printed = child.stdout.take().map(|mut pipe| {
        thread::spawn(move || {
            let mut text = String::new();
            pipe.read_to_string(&mut text).map(|_| text)
        })
    });
    let mut remarks = Vec::new();
    if let Some(pipe) = child.stderr.take() {
        for line in BufReader::new(pipe).lines() {
            let line = line.with_context(|| format!("{name} does not write UTF-8"))?;
            match progress_in(&line) {
                Some((fraction, what)) => progress.advance(fraction, what),
                None => remarks.push(line),
            }
        }
    }
    let status = child.wait().with_context(|| format!("{name} was lost"))?;
    if !status.success() {
        let why = remarks.join("\n");
        if status.code() == Some(FINDING.into()) {
            return Err(Finding(format!("{name} has a finding: {}", why.trim_end())).into());
        }
        bail!("{name} failed: {}", why.trim_end());
    }
    let printed = printed.and_then(|thread| thread.join().ok()).transpose();
    Ok(printed.with_context(|| format!("the output of {name} cannot be read"))?.unwrap_or_default())
}

/// Parses a line `progress <fraction> <what>`. Returns `None` for any other line.
fn progress_in(line: &str) -> Option<(f64, &str)> {
    let (fraction, what) = line.strip_prefix("progress ")?.split_once(' ')?;
    Some((fraction.parse().ok()?, what))
}

#[cfg(test)]
mod tests {
    use super::progress_in;

    #[test]
    fn a_progress_line_has_a_fraction_and_a_text() {
        assert_eq!(progress_in("progress 0.25 turning, 0.5 s"), Some((0.25, "turning, 0.5 s")));
        assert_eq!(progress_in("something else"), None);
    }
}

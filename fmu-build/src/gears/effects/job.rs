//! The command `effects`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

use anyhow::{Context, Result, anyhow, bail};
use clap::Args;

use super::{Question, csv, examine, reduced, table};
use crate::gears::scene::{Scene, find, units};
use crate::tools::paths;
use crate::tools::progress::Progress;

/// Finds the effects a scene needs at an accuracy, and what each changes and costs
#[derive(Args, Clone, Debug)]
pub struct EffectsCommand {
    /// A scene file, or the name of a scene
    #[arg(long, value_name = "FILE|NAME")]
    scene: String,
    /// The accuracy that the outputs need, such as 1%
    #[arg(long)]
    accuracy: String,
    /// Count outputs from this time on, such as 10ms
    #[arg(long, value_name = "TIME")]
    from: Option<String>,
    /// Only check what the scene can do without, not what it lacks
    #[arg(long)]
    as_written: bool,
    /// Also write all changes by effect and output
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Save the scene with the needed effects only [default: reduced/NAME.toml next to the scene]
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    write: Option<Option<PathBuf>>,
}

impl EffectsCommand {
    /// Runs the comparison and prints it.
    pub fn run(&self) -> Result<()> {
        let scene = find(&self.scene)?;
        let accuracy = fraction(&self.accuracy)?;
        told_by(&scene, accuracy)?;
        let from = self.from.as_deref().map(units::seconds).transpose();
        let from = from.map_err(|problem| anyhow!("--from: {problem}"))?.unwrap_or(0.0);
        let file = self.write.as_ref().map(|file| file.clone().unwrap_or_else(|| reduced::default_file(&scene)));
        // before the work, not after it
        file.as_deref().map(reduced::ensure_new).transpose()?;
        let record = self.csv.as_deref().map(|path| {
            File::create(path).map(BufWriter::new).with_context(|| format!("{} cannot be written", path.display()))
        });
        let mut record = record.transpose()?;
        let progress = Progress::start("switching effects");
        progress.begin_bar("switching effects");
        let question = Question { accuracy, from, as_written: self.as_written, timed: true };
        let found = examine(&scene, &question, &mut |done, what| progress.advance(done, what))?;
        progress.finish();
        print!("{}", table::text(&found));
        if let (Some(out), Some(path)) = (&mut record, &self.csv) {
            csv::write(&found, out)?;
            out.flush().with_context(|| format!("{} cannot be written", path.display()))?;
            println!("all changes: {}", paths::shown(path));
        }
        if let Some(file) = file {
            reduced::write(&found, &file)?;
            println!("reduced scene: {}", paths::shown(&file));
        }
        Ok(())
    }
}

/// The fraction that `text` says: "1%", "1 %" or "0.01".
pub fn fraction(text: &str) -> Result<f64> {
    let wrong = |what: &str| anyhow!("--accuracy {text}: {what}; write it as 1% or 0.01");
    let trimmed = text.trim();
    let (number, per) = match trimmed.strip_suffix('%') {
        Some(number) => (number.trim_end(), 100.0),
        None => (trimmed, 1.0),
    };
    let value = number.parse::<f64>().map_err(|_| wrong("is no number"))? / per;
    if !value.is_finite() {
        return Err(wrong("is no number"));
    }
    if value <= 0.0 {
        return Err(wrong("must be above 0: at 0 every effect would be called for"));
    }
    if value >= 1.0 {
        let meant = if per == 1.0 && value < 100.0 { format!(", did you mean {number}%?") } else { String::new() };
        return Err(wrong(&format!("must be below 100 %{meant}")));
    }
    Ok(value)
}

/// Refuses an accuracy that the scene is not computed to.
fn told_by(scene: &Scene, accuracy: f64) -> Result<()> {
    let tolerance = scene.parameters.solver.relative_tolerance;
    if accuracy < tolerance {
        bail!(
            "--accuracy {accuracy:e} is finer than scene {} is computed: its solver.relative_tolerance is {tolerance:e}; \
             tighten that in the scene, or ask for less",
            scene.name
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accuracies_are_percents_or_fractions_below_all_and_above_nothing() {
        for (text, wanted) in [("1%", 0.01), ("1 %", 0.01), (" 0.5%", 0.005), ("0.01", 0.01), ("1e-3", 0.001)] {
            assert_eq!(fraction(text).expect(text), wanted, "{text}");
        }
        for (text, told) in [
            ("", "no number"),
            ("%", "no number"),
            ("one", "no number"),
            ("nan", "no number"),
            ("inf%", "no number"),
            ("1%%", "no number"),
            ("0", "above 0"),
            ("-1%", "above 0"),
            ("100%", "below 100 %"),
            ("1", "did you mean 1%?"),
            ("1e9", "below 100 %"),
        ] {
            let problem = fraction(text).expect_err(text).to_string();
            assert!(problem.contains(told) && problem.contains("1% or 0.01"), "{text}: {problem}");
        }
    }
}

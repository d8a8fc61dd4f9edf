//! The command `accuracy`.

use std::fs;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Args;

use super::words::two;
use super::{Question, answer, chosen, front, report};
use crate::gears::scene::{Scene, find_with, script, ssv, units};
use crate::tools::paths;
use crate::tools::progress::Progress;
use crate::tools::usage;

/// Finds the cheapest model that gives wanted quantities to an accuracy, and says why
#[derive(Args, Clone, Debug)]
pub struct AccuracyCommand {
    /// A scene file, or the name of a scene
    #[arg(long, value_name = "FILE|NAME")]
    scene: String,
    /// A quantity, such as left.speed:mean; may be repeated [default: all outputs of the scene]
    #[arg(long, value_name = "OUTPUT[:STATISTIC]")]
    want: Vec<String>,
    /// The accuracy that it needs, such as 1%
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true)]
    within: String,
    /// Judge outputs from this time on, such as 10ms
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    from: Option<String>,
    /// Change the scene, such as left.load_torque=500N.m; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Folder for the table and picture of all that was tried [default: target/accuracy/NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Draw no picture (needs no Python)
    #[arg(long)]
    no_picture: bool,
    /// Save the scene with the chosen setting [default: reduced/NAME.toml next to the scene]
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    write: Option<Option<PathBuf>>,
    /// Write the start values of the chosen setting for hosts of the FMU (SSP parameter set)
    #[arg(long, value_name = "FILE")]
    ssv: Option<PathBuf>,
    /// Write the scene with the chosen setting as a Python script that runs the FMU
    #[arg(long, value_name = "FILE")]
    python: Option<PathBuf>,
}

impl AccuracyCommand {
    /// Answers.
    pub fn run(&self) -> Result<()> {
        let scene = find_with(&self.scene, &self.set).map_err(|problem| usage::error(format!("{problem:#}")))?;
        let question =
            Question { wants: self.want.clone(), within: fraction(&self.within)?, from: self.from()?, timed: true };
        let file = self.write.as_ref().map(|file| file.clone().unwrap_or_else(|| chosen::default_file(&scene)));
        // before the work, not after it
        file.as_deref().map(chosen::ensure_new).transpose()?;
        let folder = self.out.clone().unwrap_or_else(|| front::folder(&scene.name));
        paths::create_folder(&folder)?;
        for target in [&self.ssv, &self.python].into_iter().flatten() {
            paths::ensure_parent(target)?;
        }
        let begun = Instant::now();
        let progress = Progress::start("running the reference");
        progress.begin_bar("running the reference");
        let found = answer(&scene, &question, &mut |done, what| progress.advance(done, what))?;
        let took = begun.elapsed().as_secs_f64();
        let runs = front::write(&found, &folder)?;
        let picture = if self.no_picture { None } else { Some(front::draw(&found, &folder, &progress)?) };
        progress.finish();
        print!("{}", report::text(&found));
        println!(
            "\n{} runs as dear as {} of the reference, which takes {} s: {} s in all; table: {}",
            found.trials.len(),
            two(found.spent),
            two(found.reference.effort.seconds),
            two(took),
            paths::shown(&runs)
        );
        if let Some(picture) = picture {
            println!("error against cost: {}", paths::shown(&picture));
        }
        if let Some(file) = file {
            chosen::write(&found, &file)?;
            println!("scene with the chosen setting: {}", paths::shown(&file));
        }
        if let Some(chosen) = found.choice() {
            // what the setting has is the scene's now
            for (file, text) in [(&self.ssv, ssv::text as fn(&Scene) -> Result<String>), (&self.python, script::text)] {
                if let Some(file) = file {
                    let shown = paths::shown(file);
                    fs::write(file, text(&chosen.scene)?).with_context(|| format!("{shown} cannot be written"))?;
                    println!("for hosts: {shown}");
                }
            }
        }
        Ok(())
    }

    fn from(&self) -> Result<f64> {
        let from = self.from.as_deref().map(units::seconds).transpose();
        from.map(|from| from.unwrap_or(0.0)).map_err(|problem| usage::error(format!("--from: {problem}")))
    }
}

/// The fraction that `text` says: "1%", "1 %" or "0.01".
pub fn fraction(text: &str) -> Result<f64> {
    let wrong = |what: &str| usage::error(format!("--within {text}: {what}; write it as 1% or 0.01"));
    let trimmed = text.trim();
    let (number, per) = match trimmed.strip_suffix('%') {
        Some(number) => (number.trim_end(), 100.0),
        None => (trimmed, 1.0),
    };
    let value = number.parse::<f64>().map_err(|_| wrong("is no number"))? / per;
    if !value.is_finite() {
        return Err(wrong("is no number"));
    }
    if value < FINEST {
        return Err(wrong(if value > 0.0 {
            "must be 1e-6 or more: no model of gears is as accurate as that"
        } else {
            "must be above 0"
        }));
    }
    if value >= 1.0 {
        let meant = if per == 1.0 && value < 100.0 { format!(" (did you mean {number}%?)") } else { String::new() };
        return Err(wrong(&format!("must be below 100 %{meant}")));
    }
    Ok(value)
}

/// Finest accuracy that may be asked for: references are computed ten thousand times finer.
const FINEST: f64 = 1e-6;

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
            ("1e-9", "or more"),
            ("100%", "below 100 %"),
            ("200%", "below 100 %"),
            ("1", "did you mean 1%?"),
            ("1e9", "below 100 %"),
        ] {
            let problem = fraction(text).expect_err(text).to_string();
            assert!(problem.contains(told) && problem.contains("1% or 0.01"), "{text}: {problem}");
        }
    }
}

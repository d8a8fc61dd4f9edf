//! All runs of an answer as rows, and as CSV.

use anyhow::{Context, Result};
use serde::Serialize;

use super::answer::Answer;
use super::bench::Trial;
use super::words::setting;

/// One run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Reason for the run, in words.
    pub tried: String,
    /// Role of the run in the answer: chosen, cheaper, richer or reference; empty for other runs.
    pub place: &'static str,
    /// Level, law, effects, solver.
    pub setting: String,
    /// Largest error of a wanted quantity, as a fraction; for the reference, its largest change with the tolerance.
    pub error: f64,
    /// Wanted quantity with the largest error.
    pub worst: String,
    /// Evaluations of the tooth forces.
    pub evaluations: f64,
    /// Accepted steps.
    pub steps: f64,
    /// Cost of the run, in evaluations of plain teeth.
    pub price: f64,
    /// Processor time [s].
    pub seconds: f64,
    /// Error of each wanted quantity.
    #[serde(skip)]
    pub errors: Vec<f64>,
}

/// Returns all runs, with the reference last.
pub fn rows(answer: &Answer) -> Vec<Row> {
    let places = [(answer.chosen, "chosen"), (answer.too_coarse, "cheaper"), (answer.richer, "richer")];
    let place = |i: usize| places.into_iter().find(|(run, _)| *run == Some(i)).map_or("", |(_, place)| place);
    let last = Row { worst: String::new(), ..row(answer, "reference", &answer.reference) };
    answer.trials.iter().enumerate().map(|(i, trial)| row(answer, place(i), trial)).chain([last]).collect()
}

fn row(answer: &Answer, place: &'static str, trial: &Trial) -> Row {
    let (worst, error) = trial.worst();
    Row {
        tried: trial.reason.clone(),
        place,
        setting: setting(&trial.scene.parameters),
        error,
        worst: answer.wants[worst].text(&answer.scene),
        evaluations: trial.effort.evaluations,
        steps: trial.effort.steps,
        price: trial.cost,
        seconds: trial.effort.seconds,
        errors: trial.errors.clone(),
    }
}

/// Formats the rows as CSV, with a column for the error of each wanted quantity.
pub fn csv(answer: &Answer) -> Result<String> {
    let mut file = csv::Writer::from_writer(Vec::new());
    let head = ["tried", "place", "setting", "error", "worst", "evaluations", "steps", "price", "seconds"];
    let wants = answer.wants.iter().map(|want| want.text(&answer.scene));
    file.write_record(head.into_iter().map(str::to_owned).chain(wants))?;
    for row in rows(answer) {
        let numbers = [row.evaluations, row.steps, row.price, row.seconds].into_iter().chain(row.errors);
        let words = [row.tried, row.place.into(), row.setting, row.error.to_string(), row.worst];
        file.write_record(words.into_iter().chain(numbers.map(|number| number.to_string())))?;
    }
    let bytes = file.into_inner().map_err(|error| error.into_error()).context("the table of runs")?;
    Ok(String::from_utf8(bytes)?)
}

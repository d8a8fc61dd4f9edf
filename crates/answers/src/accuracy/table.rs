//! All that was tried as rows, and as CSV.

use anyhow::{Context, Result};
use serde::Serialize;

use super::answer::Answer;
use super::bench::Trial;
use super::words::setting;

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Why it was tried.
    pub tried: String,
    /// What it is in the answer: chosen, cheaper, richer, reference; empty for others.
    pub place: &'static str,
    /// Level, law, effects, solver.
    pub setting: String,
    /// The largest error, as a part of 100 %; of the reference what it strays.
    pub error: f64,
    /// The quantity that has it.
    pub worst: String,
    /// Evaluations of the tooth forces.
    pub evaluations: f64,
    /// Accepted steps.
    pub steps: f64,
    /// Price, in evaluations of plain teeth.
    pub price: f64,
    /// Time on the processor [s].
    pub seconds: f64,
    /// Error of each quantity.
    #[serde(skip)]
    pub errors: Vec<f64>,
}

/// All runs, the reference last.
pub fn rows(answer: &Answer) -> Vec<Row> {
    let places = [(answer.chosen, "chosen"), (answer.cheaper, "cheaper"), (answer.richer, "richer")];
    let place = |i: usize| places.into_iter().find(|(run, _)| *run == Some(i)).map_or("", |(_, place)| place);
    let last = Row { worst: String::new(), ..row(answer, "reference", &answer.reference) };
    answer.trials.iter().enumerate().map(|(i, trial)| row(answer, place(i), trial)).chain([last]).collect()
}

fn row(answer: &Answer, place: &'static str, trial: &Trial) -> Row {
    let (worst, error) = trial.worst();
    Row {
        tried: trial.what.clone(),
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

/// The rows with the error of each quantity.
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

//! One function that answers all questions: a question is a value of JSON, and so is the answer.
//!
//! ```
//! use answers::{ask::ask, progress::Progress};
//! let question = serde_json::json!({"ask": "geometry", "set": ["geometry.module=4mm"]});
//! let answer = ask(&serde_json::from_value(question).unwrap(), &[], &mut Progress::silent()).unwrap();
//! assert!(answer["text"].as_str().unwrap().contains("4.0000"));
//! ```

mod accuracy_and_statistics;
#[allow(unsafe_code)] // the one place that handles foreign pointers
pub mod c;
mod gears;
mod scenes;
mod source;
mod text;

use anyhow::Result;
use serde::Deserialize;
use serde_json::Value;

use crate::problem::{Problem, Problems};
use crate::progress::{Progress, Stopped};

/// What is asked. Every question is one object of JSON, whose `ask` says which.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// All scenes of a folder, with their descriptions.
    Scenes(scenes::ScenesQuestion),
    /// The former names of variables.
    FormerNames,
    /// A scene as values: what it sets, later and over time, and its outputs.
    Scene(scenes::SceneQuestion),
    /// The variables that act in a scene.
    Acting(scenes::SceneQuestion),
    /// What a scene will simulate, in words.
    Plan(scenes::SceneQuestion),
    /// A run of a scene by this library itself, recorded in a file.
    Run(scenes::RunQuestion),
    /// A scene as a file for others: `ssv`, a parameter set of SSP, or `python`, a script.
    Export(scenes::ExportQuestion),
    /// The force on each loaded tooth pair, written to a file.
    Loads(scenes::LoadsQuestion),
    /// The cheapest model that is accurate enough.
    Accuracy(accuracy_and_statistics::AccuracyQuestion),
    /// Where flanks carry.
    Pattern(scenes::PatternQuestion),
    /// Dimensions, interference and curves of gears.
    Geometry(gears::GeometryQuestion),
    /// What a word for a statistic means.
    Word(accuracy_and_statistics::StatisticNameQuestion),
    /// Figures of series over time.
    Statistics(accuracy_and_statistics::StatisticsQuestion),
    /// The cells of a CSV file.
    Table(text::TableQuestion),
    /// Names that a wrong one may mean.
    Near(text::NearQuestion),
    /// Units that a user prefers, each by the SI unit of its dimension.
    DisplayUnits(text::DisplayUnitsQuestion),
}

/// Answers a question, with the `numbers` that come beside it. `progress` reports to the caller, who may stop the work.
pub fn ask(question: &Question, numbers: &[f64], progress: &mut Progress) -> Result<Value> {
    let answer = match question {
        Question::Scenes(question) => question.answer(),
        Question::FormerNames => Ok(scenes::former_names()),
        Question::Scene(question) => question.values(progress),
        Question::Acting(question) => question.acting(progress),
        Question::Plan(question) => question.plan(progress),
        Question::Run(question) => question.answer(progress),
        Question::Export(question) => question.answer(progress),
        Question::Loads(question) => question.answer(progress),
        Question::Accuracy(question) => question.answer(progress),
        Question::Pattern(question) => question.answer(progress),
        Question::Geometry(question) => question.answer(progress),
        Question::Word(question) => question.answer(),
        Question::Statistics(question) => question.answer(numbers),
        Question::Table(question) => question.answer(),
        Question::Near(question) => Ok(question.answer()),
        Question::DisplayUnits(question) => question.answer(),
    };
    // what fails because it was stopped tells nothing else
    answer.map_err(|why| progress.check_stopped().err().map_or(why, Into::into))
}

/// Why there is no answer.
#[derive(Debug)]
pub struct Refusal {
    /// `use`: the question makes no sense; `failed`: it does, and the work came to no end; `stopped`: by whoever waited;
    /// `internal`: a fault of this library.
    pub kind: &'static str,
    /// What is wrong.
    pub problems: Vec<Problem>,
}

impl Refusal {
    /// A question that cannot be read.
    pub fn unreadable(what: impl Into<String>) -> Self {
        Self { kind: "use", problems: vec![what.into().into()] }
    }
}

impl From<anyhow::Error> for Refusal {
    fn from(error: anyhow::Error) -> Self {
        if error.downcast_ref::<Stopped>().is_some() {
            return Self { kind: "stopped", problems: vec![error.root_cause().to_string().into()] };
        }
        match error.downcast_ref::<Problems>() {
            Some(found) => {
                // what the problems are about, such as a file
                let about: String = error
                    .chain()
                    .take_while(|cause| !cause.is::<Problems>())
                    .map(|cause| format!("{cause}: "))
                    .filter(|about| !found.to_string().starts_with(about.trim_end_matches(": ")))
                    .collect();
                let problems = found.0.iter().map(|problem| problem.clone().prefixed(&about)).collect();
                Self { kind: "use", problems }
            }
            None => Self { kind: "failed", problems: vec![format!("{error:#}").into()] },
        }
    }
}

//! Function that answers all questions. Questions and answers are JSON values.
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
use bevel_differential::model::{Class, EFFECTS};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::problem::{Problem, Problems};
use crate::progress::{Progress, Stopped};

/// A question. Every question is a JSON object whose `ask` names its kind.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// All scenes of a folder, with their descriptions.
    Scenes(scenes::ScenesQuestion),
    /// Settings of clutch packs from their dimensions.
    Clutch(scenes::ClutchQuestion),
    /// Settings of all points of a measured clutch curve.
    Curve(scenes::CurveQuestion),
    /// Values of a scene: settings at the start, later and over time, and outputs.
    Scene(scenes::SceneQuestion),
    /// Variables that have an influence in a scene.
    Acting(scenes::SceneQuestion),
    /// Outputs of a scene that no effect computes, because it is off.
    Off(scenes::SceneQuestion),
    /// Description of what a scene will simulate.
    Plan(scenes::SceneQuestion),
    /// Run of a scene by this library, recorded in a file.
    Run(scenes::RunQuestion),
    /// Export of a scene: `ssv`, a parameter set of SSP, or `python`, a script.
    Export(scenes::ExportQuestion),
    /// The force on each loaded tooth pair, written to a file.
    Loads(scenes::LoadsQuestion),
    /// Switches of effects that are part of the machine, and of effects that only add outputs.
    EffectClasses {},
    /// The cheapest model that is accurate enough.
    Accuracy(accuracy_and_statistics::AccuracyQuestion),
    /// Contact patterns: areas of the flanks that bear.
    Pattern(scenes::PatternQuestion),
    /// Dimensions, interference and curves of gears.
    Geometry(gears::GeometryQuestion),
    /// Meaning of the name of a statistic.
    Word(accuracy_and_statistics::StatisticNameQuestion),
    /// Statistics of series over time.
    Statistics(accuracy_and_statistics::StatisticsQuestion),
    /// The cells of a CSV file.
    Table(text::TableQuestion),
    /// Correct names similar to a wrong one.
    Near(text::NearQuestion),
    /// A value that a user wrote, in SI.
    Value(text::ValueQuestion),
    /// The number and the unit in a text.
    Split(text::SplitQuestion),
    /// Units in which values of an SI unit may be written.
    Units(text::UnitsQuestion),
    /// Units that a user prefers, listed by the SI unit of each dimension.
    DisplayUnits(text::DisplayUnitsQuestion),
}

/// Answers a question. `numbers` are the numbers that belong to it. `progress` reports to the caller, who may stop the
/// work.
pub fn ask(question: &Question, numbers: &[f64], progress: &mut Progress) -> Result<Value> {
    let answer = match question {
        Question::Scenes(question) => question.answer(),
        Question::Clutch(question) => question.answer(),
        Question::Curve(question) => question.answer(),
        Question::Scene(question) => question.values(progress),
        Question::Acting(question) => question.acting(progress),
        Question::Off(question) => question.off(progress),
        Question::Plan(question) => question.plan(progress),
        Question::Run(question) => question.answer(progress),
        Question::Export(question) => question.answer(progress),
        Question::Loads(question) => question.answer(progress),
        Question::EffectClasses {} => Ok(effect_classes()),
        Question::Accuracy(question) => question.answer(progress),
        Question::Pattern(question) => question.answer(progress),
        Question::Geometry(question) => question.answer(progress),
        Question::Word(question) => question.answer(),
        Question::Statistics(question) => question.answer(numbers),
        Question::Table(question) => question.answer(),
        Question::Near(question) => Ok(question.answer()),
        Question::Value(question) => question.answer(),
        Question::Split(question) => question.answer(),
        Question::Units(question) => Ok(question.answer()),
        Question::DisplayUnits(question) => question.answer(),
    };
    // after a stop, other errors have no meaning
    answer.map_err(|why| progress.check_stopped().err().map_or(why, Into::into))
}

/// Names of switches by the class of their effects.
fn effect_classes() -> Value {
    let of = |class: Class| -> Vec<&str> {
        EFFECTS.iter().filter(|effect| effect.class == class).filter_map(|effect| effect.switch).collect()
    };
    json!({"machine": of(Class::Machine), "outputs": of(Class::Outputs)})
}

/// Reason for the lack of an answer.
#[derive(Debug)]
pub struct Refusal {
    /// `use`: the question makes no sense; `failed`: the question is valid, but the work failed; `stopped`: the caller
    /// stopped the work; `internal`: a fault of this library.
    pub kind: &'static str,
    /// Problems that were found.
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
                // context of the problems, such as a file
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

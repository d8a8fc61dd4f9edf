//! Function that answers all questions. Questions and answers are JSON values.
//!
//! ```
//! use answers::{ask::ask, progress::Progress};
//! let question = serde_json::json!({"ask": "geometry", "set": ["geometry.module=4mm"]});
//! let answer = ask(&serde_json::from_value(question).unwrap(), &[], &mut Progress::silent()).unwrap();
//! assert!(answer["text"].as_str().unwrap().contains("4.0000"));
//! ```

mod accuracy;
#[allow(unsafe_code)] // the one place that handles foreign pointers
pub mod c;
mod gears;
mod scenes;
mod source;
mod statistics;
mod text;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use accuracy::AccuracyQuestion;
use anyhow::Result;
use bevel_differential::model::{Class, EFFECTS};
use gears::GeometryQuestion;
use scenes::{LoadsQuestion, values};
use serde::Deserialize;
use serde_json::{Value, json};
use source::Source;
use statistics::FigureQuestion;
use text::{TableQuestion, ValueQuestion};
use toml::Table;

use crate::problem::{Problem, Problems, question_error};
use crate::progress::{Progress, Stopped};
use crate::scene::display_units::DisplayUnits;
use crate::scene::set::how_to_find;
use crate::scene::value::of_text;
use crate::scene::{acting, clutch, curve, script, ssv, units};
use crate::text::near::near;

/// A question. Every question is a JSON object whose `ask` names its kind.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case", deny_unknown_fields)]
#[allow(missing_docs)] // the comment of a question explains its fields
pub enum Question {
    /// All scenes of the folder `scenes`, with their descriptions.
    Scenes { scenes: PathBuf },
    /// Settings of clutch packs from their dimensions `of`, by name, as in a scene file.
    Clutch { of: Table },
    /// Settings of all points of a measured clutch curve. `value` is the path of a CSV file, relative to the working
    /// folder, or a list of points, as on a command line.
    Curve { value: String },
    /// Values of a scene: settings at the start, later and over time, and outputs.
    Scene { of: Source },
    /// Variables that have an influence in a scene.
    Acting { of: Source },
    /// Outputs of a scene that no effect computes, because it is off.
    Off { of: Source },
    /// Description of what a scene will simulate.
    Plan { of: Source },
    /// Run of a scene by this library, recorded in the CSV file `out`.
    Run { of: Source, out: PathBuf },
    /// Export of a scene.
    Export { of: Source, format: Format },
    /// The force on each loaded tooth pair, or the forces of the final drive, written to a file.
    Loads(LoadsQuestion),
    /// Switches of effects that are part of the machine, and of effects that only add outputs.
    EffectClasses {},
    /// The cheapest model that is accurate enough.
    Accuracy(AccuracyQuestion),
    /// Contact patterns: areas of the flanks that bear. The default scenes are the cases of the documentation. A
    /// `quick` answer is coarser: it has longer steps, and fewer of the cases of the documentation.
    Pattern {
        #[serde(default)]
        of: Vec<Source>,
        #[serde(default)]
        quick: bool,
    },
    /// Dimensions, interference and curves of gears.
    Geometry(GeometryQuestion),
    /// Canonical name of a statistic, and the angle by which an order is counted.
    Word { statistic: String },
    /// Statistics of series over time. The numbers are passed next to the question: all times, then one series after
    /// another, with `points` samples each.
    Statistics { points: usize, figures: Vec<FigureQuestion> },
    /// The cells of a CSV file.
    Table(TableQuestion),
    /// The most similar names among the `known` ones for a wrong `word`, and a hint on how to find an unknown variable.
    Near { word: String, known: Vec<String> },
    /// A value that a user wrote, in SI.
    Value(ValueQuestion),
    /// The number and the unit in a text.
    Split { text: String },
    /// Units in which values of the SI unit `unit` may be written, each with the number of it in one SI unit, and its
    /// value for 0 in SI.
    Units { unit: String },
    /// Units that a user prefers, listed by the SI unit of each dimension.
    DisplayUnits { names: Vec<String> },
}

/// File format of an exported scene.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Format {
    /// A parameter set of SSP.
    Ssv,
    /// A Python script.
    Python,
}

/// Answers a question. `numbers` are the numbers that belong to it. `progress` reports to the caller, who may stop the
/// work.
pub fn ask(question: &Question, numbers: &[f64], progress: &mut Progress) -> Result<Value> {
    let answer = answer(question, numbers, progress);
    // after a stop, other errors have no meaning
    answer.map_err(|why| progress.check_stopped().err().map_or(why, Into::into))
}

fn answer(question: &Question, numbers: &[f64], progress: &mut Progress) -> Result<Value> {
    Ok(match question {
        Question::Scenes { scenes } => scenes::list(scenes)?,
        Question::Clutch { of } => json!({"set": values(&clutch::settings(of)?)}),
        Question::Curve { value } => {
            json!({"set": values(&curve::settings(curve::CURVE, &of_text(value), Path::new(""))?)})
        }
        Question::Scene { of } => scenes::contents(&of.scene(progress)?),
        Question::Acting { of } => json!({"names": acting::names(&of.scene(progress)?)}),
        Question::Off { of } => scenes::off(&of.scene(progress)?),
        Question::Plan { of } => json!({"text": scenes::plan(&of.scene(progress)?, progress)?}),
        Question::Run { of, out } => scenes::record(&of.scene(progress)?, out, progress)?,
        Question::Export { of, format } => {
            let text = match format {
                Format::Ssv => ssv::text,
                Format::Python => script::text,
            };
            json!({"text": text(&of.scene(progress)?)?})
        }
        Question::Loads(question) => question.answer(progress)?,
        Question::EffectClasses {} => {
            json!({"machine": switches(Class::Machine), "outputs": switches(Class::Outputs)})
        }
        Question::Accuracy(question) => question.answer(progress)?,
        Question::Pattern { of, quick } => scenes::pattern(of, *quick, progress)?,
        Question::Geometry(question) => question.answer(progress)?,
        Question::Word { statistic } => statistics::word(statistic)?,
        Question::Statistics { points, figures } => statistics::figures(*points, figures, numbers)?,
        Question::Table(question) => question.answer()?,
        Question::Near { word, known } => {
            json!({"near": near(word, known.iter().map(String::as_str)), "find": how_to_find(word)})
        }
        Question::Value(question) => question.answer()?,
        Question::Split { text } => {
            let (number, unit) = units::split(text).map_err(question_error)?;
            json!({"number": number, "unit": unit})
        }
        Question::Units { unit } => {
            let others = units::others(unit).map(|shown| (shown.name, [shown.factor, shown.offset]));
            json!({"units": others.collect::<BTreeMap<_, _>>()})
        }
        Question::DisplayUnits { names } => {
            let preferred = DisplayUnits::of(names).map_err(|found| question_error(found.join("\n")))?;
            json!({"units": preferred.by_si_unit().collect::<BTreeMap<_, _>>()})
        }
    })
}

/// Names of the switches of effects of a class.
fn switches(class: Class) -> Vec<&'static str> {
    EFFECTS.iter().filter(|effect| effect.class == class).filter_map(|effect| effect.switch).collect()
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

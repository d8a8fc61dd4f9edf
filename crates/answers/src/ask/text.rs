//! Questions about texts of users: CSV files, units, and misspelt names.

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::Result;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::problem::question_error;
use crate::scene::display_units::DisplayUnits;
use crate::scene::set::how_to_find;
use crate::scene::{units, value};
use crate::text::csv_input;
use crate::text::near::near;

/// Request to read a CSV file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableQuestion {
    file: PathBuf,
    /// Text of the file as CSV, if the caller has read it.
    #[serde(default)]
    content: Option<String>,
    /// Name of the file in messages.
    shown: String,
    /// Names of columns that contain words.
    #[serde(default)]
    texts: Vec<String>,
}

/// Request about a wrong name.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearQuestion {
    word: String,
    /// Valid names.
    known: Vec<String>,
}

/// Request about display units.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DisplayUnitsQuestion {
    names: Vec<String>,
}

/// Request to read a value.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValueQuestion {
    kind: Kind,
    /// SI unit of a real number; none if it has no unit.
    #[serde(default)]
    unit: Option<String>,
    /// True for a difference, whose units have no offset.
    #[serde(default)]
    is_relative: bool,
    /// Names and numbers of the literals of an enumeration.
    #[serde(default)]
    literals: Vec<(String, i32)>,
    /// A number, true or false, or text as on a command line.
    value: Value,
}

/// Kind of a variable.
#[derive(Deserialize)]
enum Kind {
    Real,
    Integer,
    Boolean,
    Enumeration,
}

/// Request for the number and the unit in a text.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplitQuestion {
    text: String,
}

/// Request for the units of an SI unit's values.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnitsQuestion {
    unit: String,
}

impl ValueQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let written = match &self.value {
            Value::String(text) => value::of_text(text),
            Value::Bool(truth) => toml::Value::Boolean(*truth),
            other => toml::Value::Float(other.as_f64().unwrap_or(f64::NAN)),
        };
        let choices = || self.literals.iter().map(|(name, number)| (name.as_str(), *number)).collect::<Vec<_>>();
        let read = match self.kind {
            Kind::Real => {
                value::real(&written, self.unit.as_deref(), self.is_relative).map(|number| json!({"value": number}))
            }
            Kind::Integer => value::whole(&written).map(|number| json!({"value": number})),
            Kind::Boolean => value::truth(&written).map(|truth| json!({"value": truth})),
            Kind::Enumeration => value::literal(&written, &choices()).map(|number| json!({"value": number})),
        };
        read.map_err(question_error)
    }
}

impl SplitQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let (number, unit) = units::split(&self.text).map_err(question_error)?;
        Ok(json!({"number": number, "unit": unit}))
    }
}

impl UnitsQuestion {
    /// Units by name, each with the number of it in one SI unit, and its value for 0 in SI.
    pub(super) fn answer(&self) -> Value {
        let others = units::others(&self.unit).map(|shown| (shown.name, [shown.factor, shown.offset]));
        json!({"units": others.collect::<BTreeMap<_, _>>()})
    }
}

impl TableQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let is_text = |head: &str| self.texts.iter().any(|text| text == csv_input::name(head));
        let found = match &self.content {
            Some(content) => csv_input::parse(content, &is_text),
            None => csv_input::read(&self.file, &is_text),
        };
        let found = found.map_err(|problem| question_error(format!("{}{problem}", self.shown)))?;
        let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
        let rows: Vec<_> = found.rows.iter().map(|(line, record)| (line, cells(record))).collect();
        Ok(json!({"header": [found.header_line, cells(&found.header)], "rows": rows}))
    }
}

impl NearQuestion {
    /// Returns the most similar names, and a hint on how to find an unknown variable.
    pub(super) fn answer(&self) -> Value {
        json!({"near": near(&self.word, self.known.iter().map(String::as_str)), "find": how_to_find(&self.word)})
    }
}

impl DisplayUnitsQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let preferred = DisplayUnits::of(&self.names).map_err(|found| question_error(found.join("\n")))?;
        Ok(json!({"units": preferred.by_si_unit().collect::<BTreeMap<_, _>>()}))
    }
}

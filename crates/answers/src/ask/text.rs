//! Questions about texts of users: CSV files and values.

use std::path::PathBuf;

use anyhow::Result;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::problem::question_error;
use crate::scene::value;
use crate::text::csv_input;

/// Request to read a CSV file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableQuestion {
    file: PathBuf,
    /// Text of the file as CSV, if the caller has read it.
    content: Option<String>,
    /// Name of the file in messages.
    shown: String,
    /// Names of columns that contain words.
    #[serde(default)]
    texts: Vec<String>,
}

/// Request to read a value.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValueQuestion {
    kind: Kind,
    /// SI unit of a real number; none if it has no unit.
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

impl ValueQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let written = match &self.value {
            Value::String(text) => value::of_text(text),
            Value::Bool(truth) => toml::Value::Boolean(*truth),
            other => toml::Value::Float(other.as_f64().unwrap_or(f64::NAN)),
        };
        let choices = || self.literals.iter().map(|(name, number)| (name.as_str(), *number)).collect::<Vec<_>>();
        let read = match self.kind {
            Kind::Real => value::real(&written, self.unit.as_deref(), self.is_relative).map(Value::from),
            Kind::Integer => value::whole(&written).map(Value::from),
            Kind::Boolean => value::truth(&written).map(Value::from),
            Kind::Enumeration => value::literal(&written, &choices()).map(Value::from),
        };
        Ok(json!({"value": read.map_err(question_error)?}))
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

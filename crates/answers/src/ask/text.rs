//! Questions about texts of users: CSV files, units, and misspelt names.

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::Result;
use bevel_differential::model::removed_method;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::problem::question_error;
use crate::scene::display_units::DisplayUnits;
use crate::scene::set::how_to_find;
use crate::text::csv_input;
use crate::text::near::near;

/// Request to read a CSV file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableQuestion {
    file: PathBuf,
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

impl TableQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let texts: Vec<&str> = self.texts.iter().map(String::as_str).collect();
        let found = csv_input::read(&self.file, &texts)
            .map_err(|problem| question_error(format!("{}{problem}", self.shown)))?;
        let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
        let rows: Vec<_> = found.rows.iter().map(|(line, record)| (line, cells(record))).collect();
        Ok(json!({"header": [found.header_line, cells(&found.header)], "rows": rows}))
    }
}

impl NearQuestion {
    /// Returns the most similar names, a hint on how to find an unknown variable, and advice on a removed choice.
    pub(super) fn answer(&self) -> Value {
        let known = || self.known.iter().map(String::as_str);
        let removed = removed_method(&self.word, known());
        json!({"near": near(&self.word, known()), "find": how_to_find(&self.word), "removed": removed})
    }
}

impl DisplayUnitsQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let preferred = DisplayUnits::of(&self.names).map_err(|found| question_error(found.join("\n")))?;
        Ok(json!({"units": preferred.by_si_unit().collect::<BTreeMap<_, _>>()}))
    }
}

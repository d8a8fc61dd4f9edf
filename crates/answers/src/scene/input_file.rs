//! Inputs over time from a CSV file: a column of times and a column for each input, with units in the header.
//! `text::csv_input` describes the accepted formats.
//!
//! ```csv
//! # anything after a hash is a comment
//! time [s],carrier.speed_command [rpm],left.load_torque [N·m]
//! 0,0,0
//! 0.5,300,835
//! ```

use std::path::Path;

use bevel_differential::variables::{Access, Variable};
use csv::StringRecord;
use schedule::Table;
use toml::Value;

use super::set::{real, variable};
use super::{InputTable, former_names, units};
use crate::text;
use crate::text::csv_input::{self, CsvInput};

/// Name of the column of times.
const TIME: &str = "time";

/// Column of an input.
struct Column {
    /// Index of the column.
    place: usize,
    /// Header as written.
    header_cell: String,
    /// The input.
    row: &'static Variable,
    /// Unit as written; empty if it is missing.
    unit: String,
    /// Values in the unit of the interface.
    values: Vec<f64>,
    /// First problem of the values.
    wrong: Option<String>,
    /// Number of problems of the values.
    wrong_count: usize,
}

/// Returns the inputs in `file`, all repeated after `period` [s] if there is one, and messages about former names.
/// Fails with all problems of the file.
pub fn read(file: &Path, period: Option<f64>) -> Result<(Vec<InputTable>, Vec<String>), Vec<String>> {
    let shown = text::shown(file);
    let found = match csv_input::read(file, &[]) {
        Ok(found) => tables(found, period),
        Err(problem) if file.is_file() => Err(vec![problem]),
        Err(problem) => Err(vec![format!("{problem}; the path in file = is relative to the scene's own file")]),
    };
    found.map_err(|problems| problems.iter().map(|problem| format!("{shown}{problem}")).collect())
}

/// Returns the inputs in a file, and messages about former names. Problems begin with their position in the file.
fn tables(found: CsvInput, period: Option<f64>) -> Result<(Vec<InputTable>, Vec<String>), Vec<String>> {
    let header = found.header;
    let (time_place, time_unit, mut columns) = columns(&header)?;
    let mut times = Vec::new();
    let mut problems = Vec::new();
    for (line, record) in found.rows {
        match time(&record[time_place], &time_unit, times.last().copied()) {
            Ok(time) => times.push(time),
            Err(problem) => {
                let (header_cell, cell) = (&header[time_place], &record[time_place]);
                problems.push(format!(", line {line}, column {header_cell}, value \"{cell}\": {problem}"));
                // later times cannot be compared with this invalid one
                break;
            }
        }
        columns.iter_mut().for_each(|column| column.take(line, &record[column.place]));
    }
    problems.extend(columns.iter().filter_map(Column::problem));
    if times.is_empty() && problems.is_empty() {
        problems.push(": has no values; write a line for each time below the header".into());
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    let of = |Column { row, values, .. }| InputTable { row, table: Table::straight(times.clone(), values, period) };
    let notes = former_names::notes(columns.iter().map(|column| split_header_cell(&column.header_cell).0));
    Ok((columns.into_iter().map(of).collect(), notes))
}

/// Index and unit of the column of times, and the columns of inputs.
fn columns(header: &StringRecord) -> Result<(usize, String, Vec<Column>), Vec<String>> {
    let mut columns: Vec<Column> = Vec::new();
    let mut time = None;
    let mut problems = Vec::new();
    for (place, header_cell) in header.iter().enumerate() {
        let (name, unit) = split_header_cell(header_cell);
        if name == TIME && time.is_none() {
            let known = units::seconds(&format!("0 {unit}")).map(|_| unit.to_owned());
            time = Some((place, known.map_err(|_| wrong_time_unit(header_cell, unit))));
            continue;
        }
        match input(name, unit) {
            Ok(row) if columns.iter().any(|column| column.row.name == row.name) => {
                problems.push(format!(", column {header_cell}: the input is here twice; remove one of the columns"));
            }
            Ok(row) => columns.push(Column {
                place,
                header_cell: header_cell.to_owned(),
                row,
                unit: unit.to_owned(),
                values: Vec::new(),
                wrong: None,
                wrong_count: 0,
            }),
            Err(problem) => problems.push(format!(", column {header_cell}: {problem}")),
        }
    }
    match time {
        Some((place, Ok(unit))) if problems.is_empty() && !columns.is_empty() => return Ok((place, unit, columns)),
        Some((_, Ok(_))) if problems.is_empty() => {
            problems.push(": has times but no inputs; add a column such as left.load_torque [N.m]".into());
        }
        Some((_, Ok(_))) => {}
        Some((_, Err(problem))) => problems.push(problem),
        // the other columns may be misread
        None => {
            problems = vec![format!(
                ", header \"{}\": has no column time; the first line names the columns, separated by commas, semicolons or \
                 tabs: time [s],left.load_torque [N.m]",
                header.iter().collect::<Vec<_>>().join(",")
            )];
        }
    }
    Err(problems)
}

fn wrong_time_unit(header_cell: &str, unit: &str) -> String {
    format!(", column {header_cell}: {unit} is not a unit of time; write one of {}", units::times().join(", "))
}

/// Finds the input `name` if it may be given in `unit`.
fn input(name: &str, unit: &str) -> Result<&'static Variable, String> {
    let row = variable(name)?;
    if !matches!(row.access, Access::Input(_)) {
        return Err(format!("{name} is not an input; parameters belong in [set]"));
    }
    if !unit.is_empty() {
        units::check(row, unit)?;
    }
    Ok(row)
}

/// Splits `name [unit]`. The unit is empty if it is missing.
pub(super) fn split_header_cell(header_cell: &str) -> (&str, &str) {
    let parts = header_cell.strip_suffix(']').and_then(|rest| rest.rsplit_once('['));
    parts.map_or((header_cell, ""), |(name, unit)| (name.trim(), unit.trim()))
}

fn time(cell: &str, unit: &str, before: Option<f64>) -> Result<f64, String> {
    cell.parse::<f64>().map_err(|_| not_a_number())?;
    let time = units::seconds(&format!("{cell} {unit}"))?;
    match before {
        _ if !time.is_finite() => Err("is not a finite number".into()),
        None if time < 0.0 => Err("times begin at 0 or later".into()),
        Some(before) if time < before => {
            Err("is earlier than in the line above; sort the lines by time, and write a jump as two lines of one time"
                .into())
        }
        _ => Ok(time),
    }
}

/// Value of a cell in the column's unit, as in a scene. Fails if it is not a number.
pub(super) fn cell_value(cell: &str, unit: &str) -> Result<Value, String> {
    let number: f64 = cell.parse().map_err(|_| not_a_number())?;
    Ok(if unit.is_empty() { Value::Float(number) } else { Value::String(format!("{cell} {unit}")) })
}

fn not_a_number() -> String {
    "is not a number; write one with a decimal point, and its unit in the header".into()
}

impl Column {
    /// Adds the value in a cell.
    fn take(&mut self, line: u64, cell: &str) {
        match self.value(cell) {
            Ok(value) => self.values.push(value),
            Err(problem) => {
                let first = || format!(", line {line}, column {}, value \"{cell}\": {problem}", self.header_cell);
                self.wrong = self.wrong.take().or_else(|| Some(first()));
                self.wrong_count += 1;
            }
        }
    }

    /// Parses a cell into the variable's own unit.
    fn value(&self, cell: &str) -> Result<f64, String> {
        real(self.row, &cell_value(cell, &self.unit)?)
    }

    fn problem(&self) -> Option<String> {
        let first = self.wrong.as_ref()?;
        Some(match self.wrong_count - 1 {
            0 => first.clone(),
            more => format!("{first} (and {more} more in this column)"),
        })
    }
}

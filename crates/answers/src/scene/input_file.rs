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

use schedule::Table;

use super::input_columns::{Column, Found, Wanted, not_a_number};
use super::{InputTable, units};
use crate::text;
use crate::text::csv_input::{self, CsvInput};

/// Returns the inputs in `file`, all repeated after `period` [s] if there is one, and messages about columns that are
/// not used. `content`: text of the file as CSV, if the caller has read it. Fails with all problems of the file.
pub fn read(
    file: &Path,
    content: Option<&str>,
    period: Option<f64>,
    wanted: &Wanted,
) -> Result<(Vec<InputTable>, Vec<String>), Vec<String>> {
    let shown = text::shown(file);
    let is_text = |head: &str| !wanted.uses(head);
    let read = match content {
        Some(content) => csv_input::parse(content, &is_text),
        None => csv_input::read(file, &is_text),
    };
    let found = match read {
        Ok(found) => tables(found, period, wanted),
        Err(problem) if content.is_some() || file.is_file() => Err(vec![problem]),
        Err(problem) => Err(vec![format!("{problem}; the path in file = is relative to the scene's own file")]),
    };
    let (tables, notes) =
        found.map_err(|problems| problems.iter().map(|problem| format!("{shown}{problem}")).collect::<Vec<_>>())?;
    Ok((tables, notes.into_iter().map(|note| format!("{shown}{note}")).collect()))
}

/// Returns the inputs in a file and messages about its columns. Problems and messages begin with their position in the file.
fn tables(
    found: CsvInput,
    period: Option<f64>,
    wanted: &Wanted,
) -> Result<(Vec<InputTable>, Vec<String>), Vec<String>> {
    let header = found.header;
    let Found { time: (time_place, time_unit), mut columns, outputs } = wanted.find(&header)?;
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
    let unused = outputs.iter().map(|head| format!(", column {head}: it is an output, so no input follows it"));
    let notes = unused.chain(columns.iter().filter_map(|column| column.without_unit(wanted))).collect();
    let of = |Column { row, values, .. }| InputTable { row, table: Table::straight(times.clone(), values, period) };
    Ok((columns.into_iter().map(of).collect(), notes))
}

fn time(cell: &str, unit: &str, before: Option<f64>) -> Result<f64, String> {
    cell.parse::<f64>().map_err(|_| not_a_number())?;
    let time = units::seconds(&format!("{cell} {unit}"))?;
    match before {
        _ if !time.is_finite() => Err("it is not a finite number".into()),
        None if time < 0.0 => Err("times begin at 0 or later".into()),
        Some(before) if time < before => Err(
            "it is earlier than in the line above; sort the lines by time, and write a jump as two lines of one time"
                .into(),
        ),
        _ => Ok(time),
    }
}

//! Measured clutch curve of a scene as a list of points or as a CSV file. It becomes the settings of all points.
//!
//! ```toml
//! limited_slip.curve = [["0 rpm", "50 N.m"], [30.0, 90.0]]    # pairs of slip and torque
//! limited_slip.curve = "clutch.csv"                           # relative to the scene's file
//! ```
//!
//! ```csv
//! slip [rpm],torque [N·m]
//! 0,50
//! 100,80
//! ```

use std::path::Path;

use bevel_differential::variables::{Variable, named};
use csv::StringRecord;
use toml::Value;

use super::input_columns::{cell_value, split_header_cell};
use super::set::{Setting, SettingValue, real};
use super::units;
use super::value::written;
use crate::problem::{Problem, Problems};
use crate::text;
use crate::text::csv_input::{self, CsvInput};

/// Name of the curve in scenes. The FMU has only the variables of its points.
pub const CURVE: &str = "limited_slip.curve";
/// Names of the two values of a point.
const COLUMNS: [&str; 2] = ["slip", "torque"];
/// Header of a file, for messages.
const HEADER: &str = "slip [rpm],torque [N.m]";
/// Problem of an empty list, with its remedy.
const EMPTY: &str = "it has no points; give at least one, or leave the curve out; [[0, 0]] removes a curve";

/// A point as the user wrote it.
struct Point {
    /// Position in messages.
    place: String,
    /// Slip and torque.
    values: [Value; 2],
}

/// Settings for the key `name` of a scene: all points for the curve, otherwise one setting. A path in `value` is
/// relative to `folder`. Fails with all problems of the value.
pub fn settings(name: &str, value: &Value, folder: &Path) -> Result<Vec<Setting>, Problems> {
    if name != CURVE {
        return Ok(vec![Setting::new(name, value)?]);
    }
    let points = match value {
        Value::String(text) if is_list(text) => match text.parse() {
            Ok(Value::Array(points)) => listed(&points),
            _ => Err(wrong(text, "it is not a list such as [[0, 50], [\"100 rpm\", \"80 N.m\"]]")),
        },
        Value::String(path) => in_file(&folder.join(path)),
        Value::Array(points) => listed(points),
        _ => Err(wrong(&written(value), "it must be a list of points [slip, torque], or the path of a CSV file")),
    };
    checked(&points?)
}

/// True if the text of a curve is a list, as on the command line, and not a path.
pub fn is_list(text: &str) -> bool {
    text.trim_start().starts_with('[')
}

/// Returns the problem of the key `name` if it sets the same variable as one of the keys `before`.
pub fn set_twice(name: &str, before: &[&str]) -> Option<String> {
    let is_same = |key: &str| key == name || name == CURVE && is_point(key) || key == CURVE && is_point(name);
    let key = before.iter().find(|key| is_same(key))?;
    Some(if *key == name {
        format!("{name} is set twice; leave one out")
    } else {
        let point = if name == CURVE { key } else { name };
        format!("{CURVE} sets all points, and {point} is set as well; leave one out")
    })
}

/// True if the variable `name` belongs to a point of the curve.
pub fn is_point(name: &str) -> bool {
    name.strip_prefix(CURVE).is_some_and(|rest| rest.starts_with('['))
}

/// Variables of slip and torque of all points, in their order.
fn rows() -> Vec<[&'static Variable; 2]> {
    let point = |number: usize| COLUMNS.map(|column| named(&format!("{CURVE}[{number}].{column}")));
    (1..)
        .map_while(|number| if let [Some(slip), Some(torque)] = point(number) { Some([slip, torque]) } else { None })
        .collect()
}

/// Problem of the whole value `written`.
fn wrong(written: &str, what: &str) -> Problems {
    Problem::of(CURVE, written, format!("{CURVE} = {written}: {what}")).into()
}

/// Points of a list.
fn listed(points: &[Value]) -> Result<Vec<Point>, Problems> {
    if points.is_empty() {
        return Err(wrong("[]", EMPTY));
    }
    let (mut found, mut problems) = (Vec::new(), Problems::default());
    for (point, number) in points.iter().zip(1..) {
        let place = format!("{CURVE}, point {number}");
        match point.as_array().map(Vec::as_slice) {
            Some([slip, torque]) => found.push(Point { place, values: [slip.clone(), torque.clone()] }),
            Some(entries) => {
                problems
                    .push(problem(format!("{place} has {} entries; a point is a pair [slip, torque]", entries.len())));
            }
            None => problems.push(problem(format!("{place} = {}: a point is a pair [slip, torque]", written(point)))),
        }
    }
    problems.or(found)
}

/// Points of a CSV file.
fn in_file(file: &Path) -> Result<Vec<Point>, Problems> {
    let of_file = |problem: String| format!("{CURVE}: {}{problem}", text::shown(file));
    let read = csv_input::read(file, &|_| false).map_err(|problem| {
        let relative = "a path in a scene is relative to the scene's file, any other path to the working folder";
        vec![if file.is_file() { problem } else { format!("{problem}; {relative}") }]
    });
    let points = read
        .and_then(|found| points_of(&found))
        .map_err(|found| Problems(found.into_iter().map(of_file).map(problem).collect()))?;
    Ok(points.into_iter().map(|point| Point { place: of_file(point.place), ..point }).collect())
}

/// Points of the cells of a file. Their places and the problems begin with the position in the file.
fn points_of(found: &CsvInput) -> Result<Vec<Point>, Vec<String>> {
    let columns = columns(&found.header)?;
    if found.rows.is_empty() {
        return Err(vec![": has no points; write a line for each one below the header".into()]);
    }
    let (mut points, mut problems) = (Vec::new(), Vec::new());
    for (line, record) in &found.rows {
        let read = columns.each_ref().map(|(index, unit)| cell_value(&record[*index], unit));
        for ((index, _), what) in
            columns.iter().zip(&read).filter_map(|(column, read)| Some((column, read.as_ref().err()?)))
        {
            let (head, cell) = (&found.header[*index], &record[*index]);
            problems.push(format!(", line {line}, column {head}, value \"{cell}\": {what}"));
        }
        if let [Ok(slip), Ok(torque)] = read {
            points.push(Point { place: format!(", line {line}"), values: [slip, torque] });
        }
    }
    if problems.is_empty() { Ok(points) } else { Err(problems) }
}

/// Index and unit of the columns of slip and torque.
fn columns(header: &StringRecord) -> Result<[(usize, String); 2], Vec<String>> {
    let mut places: [Option<(usize, String)>; 2] = [None, None];
    let mut problems = Vec::new();
    let rows = rows();
    for (index, head) in header.iter().enumerate() {
        let (name, unit) = split_header_cell(head);
        let Some(which) = COLUMNS.iter().position(|column| *column == name) else {
            problems.push(format!(", column {head}: is not a column of a curve; write the header as {HEADER}"));
            continue;
        };
        let fits =
            if unit.is_empty() { Ok(()) } else { rows.first().map_or(Ok(()), |row| units::check(row[which], unit)) };
        problems.extend(fits.err().map(|problem| format!(", column {head}: {problem}")));
        if places[which].replace((index, unit.to_owned())).is_some() {
            problems.push(format!(", column {head}: is here twice; remove one of the columns"));
        }
    }
    for (column, _) in COLUMNS.iter().zip(&places).filter(|(_, place)| place.is_none()) {
        let head = header.iter().collect::<Vec<_>>().join(",");
        problems.push(format!(", header \"{head}\": has no column {column}; write the header as {HEADER}"));
    }
    match places {
        [Some(slip), Some(torque)] if problems.is_empty() => Ok([slip, torque]),
        _ => Err(problems),
    }
}

/// Settings of all points. Points that are not given are unset, which is slip 0 and torque 0.
fn checked(points: &[Point]) -> Result<Vec<Setting>, Problems> {
    let (rows, mut problems) = (rows(), Problems::default());
    if let Some(first) = points.get(rows.len()) {
        let (most, count) = (rows.len(), points.len());
        let what = format!("a curve has at most {most} points, and this one has {count}; leave some out");
        problems.push(problem(format!("{}: {what}", first.place)));
    }
    let setting = |row, number| Setting { row, value: SettingValue::Real(number) };
    let (mut settings, mut before) = (Vec::new(), None);
    for (rows, point) in rows.iter().zip(points) {
        let read = [0, 1].map(|column| number(rows[column], COLUMNS[column], point, &point.values[column]));
        let slip = read[0].as_ref().ok().copied();
        if let (Some(slip), Some(before)) = (slip, before)
            && slip <= before
        {
            problems.push(not_rising(rows[0], point, slip, before));
        }
        before = slip;
        for (row, read) in rows.iter().zip(read) {
            match read {
                Ok(number) => settings.push(setting(row, number)),
                Err(found) => problems.push(found),
            }
        }
    }
    settings.extend(rows.iter().skip(points.len()).flatten().map(|row| setting(row, 0.0)));
    problems.or(settings)
}

/// Slip or torque of `point` in the unit of the interface.
fn number(row: &'static Variable, column: &str, point: &Point, value: &Value) -> Result<f64, Problem> {
    real(row, value).map_err(|what| {
        let written = written(value);
        let message = format!("{}, {column} = {written}: {what}", point.place);
        Problem { hint: Problem::from(what).hint, ..Problem::of(row.name, written, message) }.about(row)
    })
}

/// Problem of a `slip` that is not above the slip `before` [rad/s].
fn not_rising(row: &'static Variable, point: &Point, slip: f64, before: f64) -> Problem {
    let [shown, before] = [slip, before].map(|slip| units::text(row, slip));
    let what = format!("is not above the slip of the point before, {before}; sort the points by slip, each slip once");
    Problem::of(row.name, &shown, format!("{}, slip = {shown} {what}", point.place)).about(row)
}

/// Problem of the curve.
fn problem(message: impl Into<String>) -> Problem {
    Problem { variable: Some(CURVE.into()), ..Problem::from(message.into()) }
}

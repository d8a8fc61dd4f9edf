//! Columns of an input file: by their own names, which are those of inputs, or as a scene names them.
//!
//! A column of a vehicle's speed becomes the speed of a shaft by the radius of the wheels.

use bevel_differential::variables::{Access, Variable};
use csv::StringRecord;
use toml::Value;

use super::set::{real, variable};
use super::units;
use crate::text::near;

/// Name of the column of times.
pub const TIME: &str = "time";
/// Name of a column with the speed of the vehicle, and the input that follows it.
const SPEED: [&str; 2] = ["speed", "carrier.speed_command"];
/// Key of a scene with the radius of the wheels.
const RADIUS: &str = "wheel_radius";

/// Choice of columns in a scene.
#[derive(Default)]
pub struct Wanted {
    /// Names of inputs, each with the header of its column. If there are none, all columns have the names of inputs.
    pub columns: Vec<(String, String)>,
    /// Radius of the wheels [m], by which speeds of the vehicle are divided.
    pub wheel_radius: Option<f64>,
}

/// Column of times and columns of inputs.
pub struct Found {
    /// Index and unit of the column of times.
    pub time: (usize, String),
    /// Columns of inputs.
    pub columns: Vec<Column>,
    /// Headers of columns that are not used, because they are outputs.
    pub outputs: Vec<String>,
}

/// Column of an input.
pub struct Column {
    /// Index of the column.
    pub place: usize,
    /// Header as written.
    header_cell: String,
    /// The input.
    pub row: &'static Variable,
    /// Unit as written; empty if it is missing.
    unit: String,
    /// Radius of the wheels [m], if the column has the speed of the vehicle.
    radius: Option<f64>,
    /// Values in the unit of the interface.
    pub values: Vec<f64>,
    /// First problem of the values.
    wrong: Option<String>,
    /// Number of problems of the values.
    wrong_count: usize,
}

impl Wanted {
    /// True if a scene uses the column with the header `head`.
    pub fn uses(&self, head: &str) -> bool {
        self.columns.is_empty()
            || split_header_cell(head).0 == TIME
            || self.columns.iter().any(|(_, written)| is_meant(head, written))
    }

    /// Finds the columns in `header`. Fails with all problems of the header.
    pub fn find(&self, header: &StringRecord) -> Result<Found, Vec<String>> {
        let named = if self.columns.is_empty() { Ok(by_own_names(header)) } else { self.named(header) };
        let (mut time, mut columns, mut outputs) = (None, Vec::<Column>::new(), Vec::new());
        let mut problems = Vec::new();
        for (place, name, unit) in named? {
            let header_cell = &header[place];
            if name == TIME && time.is_none() {
                time = Some((place, unit));
                continue;
            }
            if self.columns.is_empty() && variable(&name).is_ok_and(|row| matches!(row.access, Access::Output(_))) {
                outputs.push(header_cell.to_owned());
                continue;
            }
            match self.column(place, header_cell, &name, unit) {
                Ok(column) if columns.iter().any(|known| known.row.name == column.row.name) => {
                    let what = "the input is here twice; remove one of the columns";
                    problems.push(format!(", column {header_cell}: {what}"));
                }
                Ok(column) => columns.push(column),
                Err(problem) => problems.push(format!(", column {header_cell}: {problem}")),
            }
        }
        // the other columns may be misread
        let Some((place, unit)) = time else { return Err(vec![no_time(header)]) };
        if units::seconds(&format!("0 {unit}")).is_err() {
            let known = units::names("s");
            let head = &header[place];
            problems.push(format!(", column {head}: {unit} is not a unit of time; write one of {known}"));
        }
        if columns.is_empty() && problems.is_empty() {
            problems.extend(outputs.iter().map(|head| format!(", column {head}: {}", not_an_input(head))));
        }
        if columns.is_empty() && problems.is_empty() {
            problems.push(": has times but no inputs; add a column such as left.load_torque [N.m]".into());
        }
        if self.wheel_radius.is_some() && columns.iter().all(|column| column.radius.is_none()) && problems.is_empty() {
            problems
                .push(format!(": {RADIUS} has no effect, because no column has a speed in {}", units::names("m/s")));
        }
        if problems.is_empty() { Ok(Found { time: (place, unit), columns, outputs }) } else { Err(problems) }
    }

    /// Index, name and unit of the columns that the scene names, and of the times.
    fn named(&self, header: &StringRecord) -> Result<Vec<(usize, String, String)>, Vec<String>> {
        let (mut found, mut problems) = (Vec::new(), Vec::new());
        for (name, written) in &self.columns {
            let meant = |exactly: bool| {
                let is_meant = move |head: &str| if exactly { head == written } else { is_meant(head, written) };
                header.iter().enumerate().filter(move |(_, head)| is_meant(head)).map(|(place, _)| place)
            };
            let places: Vec<usize> = if meant(true).next().is_some() { meant(true) } else { meant(false) }.collect();
            match places[..] {
                [place] => {
                    let unit = [&header[place], written].map(|head| split_header_cell(head).1);
                    found.push((place, name.clone(), if unit[0].is_empty() { unit[1] } else { unit[0] }.to_owned()));
                }
                [] => {
                    let hint = near::hint(written, header);
                    let known = header.iter().collect::<Vec<_>>().join(", ");
                    problems.push(format!(": it has no column \"{written}\"{hint}; its columns: {known}"));
                }
                _ => problems.push(format!(": it has {} columns \"{written}\"; rename the others", places.len())),
            }
        }
        if self.columns.iter().all(|(name, _)| name != TIME) {
            found.extend(by_own_names(header).into_iter().find(|(_, name, _)| name == TIME));
        }
        if problems.is_empty() { Ok(found) } else { Err(problems) }
    }

    /// Column of the input `name` in `unit`.
    fn column(&self, place: usize, header_cell: &str, name: &str, unit: String) -> Result<Column, String> {
        let is_speed = name == SPEED[0];
        let row = variable(if is_speed { SPEED[1] } else { name })?;
        if !matches!(row.access, Access::Input(_)) {
            return Err(not_an_input(name));
        }
        let turns = row.unit.is_some_and(|unit| unit.name == "rad/s");
        let fits_speed = units::parse(&format!("1 {unit}"), Some("m/s"), false).is_ok();
        let radius = match self.wheel_radius {
            _ if !(is_speed || turns && fits_speed) => None,
            Some(radius) => Some(radius),
            None => {
                let what = "it is the speed of the vehicle; give the radius of the wheels next to file";
                return Err(format!("{what}: {RADIUS} = \"334 mm\""));
            }
        };
        match radius {
            _ if unit.is_empty() => {}
            Some(_) if fits_speed => {}
            Some(_) => return Err(format!("unit {unit} does not fit; units that do: {}", units::names("m/s"))),
            None => units::check(row, &unit)?,
        }
        let (header_cell, values) = (header_cell.to_owned(), Vec::new());
        Ok(Column { place, header_cell, row, unit, radius, values, wrong: None, wrong_count: 0 })
    }
}

/// Index, name and unit of all columns.
fn by_own_names(header: &StringRecord) -> Vec<(usize, String, String)> {
    let split = |(place, head)| {
        let (name, unit) = split_header_cell(head);
        (place, name.to_owned(), unit.to_owned())
    };
    header.iter().enumerate().map(split).collect()
}

/// True if a scene that writes `written` means the column `head`, whose unit may be left out in one of both.
fn is_meant(head: &str, written: &str) -> bool {
    let ((name, unit), (wanted, wanted_unit)) = (split_header_cell(head), split_header_cell(written));
    head == written || name == wanted && (unit.is_empty() || wanted_unit.is_empty())
}

fn not_an_input(head: &str) -> String {
    format!("{} is not an input; parameters belong in [set]", split_header_cell(head).0)
}

fn no_time(header: &StringRecord) -> String {
    format!(
        ", header \"{}\": has no column time; the first line names the columns, separated by commas, semicolons or tabs: \
         time [s],left.load_torque [N.m]; a scene names other columns by columns = {{\"time\" = \"t [s]\"}}",
        header.iter().collect::<Vec<_>>().join(",")
    )
}

/// Splits `name [unit]` or `name (unit)`. The unit is empty if it is missing.
pub fn split_header_cell(header_cell: &str) -> (&str, &str) {
    let split = |end: char, begin: char| header_cell.strip_suffix(end).and_then(|rest| rest.rsplit_once(begin));
    let parts = split(']', '[').or_else(|| split(')', '('));
    // "planet[1]" is a name
    let parts = parts.filter(|(_, unit)| unit.parse::<u32>().is_err());
    parts.map_or((header_cell, ""), |(name, unit)| (name.trim(), unit.trim()))
}

/// Value of a cell in the column's unit, as in a scene. Fails if it is not a number.
pub fn cell_value(cell: &str, unit: &str) -> Result<Value, String> {
    let number: f64 = cell.parse().map_err(|_| not_a_number())?;
    Ok(if unit.is_empty() { Value::Float(number) } else { Value::String(format!("{cell} {unit}")) })
}

/// Problem of a cell that is not a number.
pub fn not_a_number() -> String {
    "it is not a number; write one with a decimal point, and its unit in the header".into()
}

impl Column {
    /// Message about a column that the scene names, whose numbers have no unit although users expect another one than that
    /// of the interface.
    pub fn without_unit(&self, wanted: &Wanted) -> Option<String> {
        let (row, head) = (self.row, &self.header_cell);
        let [unit, usual] = [row.unit?.name, row.display?.name];
        let is_bare = self.unit.is_empty() && !wanted.columns.is_empty();
        is_bare.then(|| {
            format!(
                ", column {head}: it has no unit, so its numbers are in {unit}; write one, as in \"{head} [{usual}]\""
            )
        })
    }

    /// Adds the value in a cell.
    pub fn take(&mut self, line: u64, cell: &str) {
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
        let value = cell_value(cell, &self.unit)?;
        let Some(radius) = self.radius else { return real(self.row, &value) };
        let speed = super::value::real(&value, Some("m/s"), false)?;
        real(self.row, &Value::Float(speed / radius))
    }

    /// First problem of the values, and the number of the others.
    pub fn problem(&self) -> Option<String> {
        let first = self.wrong.as_ref()?;
        Some(match self.wrong_count - 1 {
            0 => first.clone(),
            more => format!("{first} (and {more} more in this column)"),
        })
    }
}

//! The assembled table, range checks and the GUID.

use std::fmt::Write as _;
use std::sync::OnceLock;

use super::written::written_as_shown;
use super::{Access, Variable};
use crate::declaration::{Causality, Range, Row, Rows, Variability};
use crate::model::{Inputs, Parameters, STATES};
use crate::problem::Problem;
use crate::static_memory::{store_all, store_text};

/// Table of all variables. The value reference of a variable is its index.
pub struct Table {
    /// The rows.
    pub rows: &'static [Variable],
    /// Indices of the outputs, ascending.
    pub outputs: &'static [usize],
    /// Indices of the inputs, ascending.
    pub inputs: &'static [usize],
    /// Indices of the continuous states, in their order.
    pub states: [usize; STATES],
    /// Indices of the derivatives of the states.
    pub derivatives: [usize; STATES],
}

impl Table {
    /// Returns the number of a continuous state among the states, or `None` for another variable.
    pub fn state(&self, reference: u32) -> Option<usize> {
        self.states.iter().position(|&index| index as u32 == reference)
    }

    /// Value references of the outputs that are real numbers, ascending.
    pub fn real_outputs(&self) -> impl Iterator<Item = u32> + Clone {
        self.outputs.iter().filter(|&&i| self.rows[i].access.enumeration().is_none()).map(|&i| i as u32)
    }

    /// True if the variable is a velocity state. Imposed speeds may set these states at events.
    pub fn is_velocity(&self, reference: u32) -> bool {
        self.state(reference).is_some_and(|k| k >= STATES / 2)
    }
}

/// Returns the table.
pub fn table() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut rows: Vec<Variable> = Vec::new();
        rows.extend(by_group(Parameters::rows()).into_iter().map(|row| row.map(Access::from)));
        rows.extend(by_group(super::inputs::rows()).into_iter().map(|row| row.map(Access::Input)));
        rows.extend(by_group(super::outputs::rows()).into_iter().map(|row| row.map(Access::Output)));
        rows.extend(by_group(super::calculated::rows()).into_iter().map(|row| row.map(Access::Output)));
        let (states, derivatives) = super::states::complete(&mut rows);
        let of = |c| store_all(&(0..rows.len()).filter(|&i| rows[i].causality == c).collect::<Vec<_>>());
        let (inputs, outputs) = (of(Causality::Input), of(Causality::Output));
        Table { rows: store_all(&rows), outputs, inputs, states, derivatives }
    })
}

/// Returns `rows` sorted by the first part of their names. Groups and variables keep their order.
fn by_group<A: Copy>(rows: Vec<Row<A>>) -> Vec<Row<A>> {
    let mut groups: Vec<&str> = Vec::new();
    let mut rank = |row: &Row<A>| {
        let group = row.name.split('.').next().unwrap_or(row.name);
        // most variables belong to the group of the one before
        groups.iter().rposition(|name| *name == group).unwrap_or_else(|| {
            groups.push(group);
            groups.len() - 1
        })
    };
    let mut ranks: Vec<(usize, usize)> = rows.iter().enumerate().map(|(i, row)| (rank(row), i)).collect();
    ranks.sort_unstable();
    ranks.into_iter().map(|(_, i)| rows[i]).collect()
}

/// Returns the start value of a real parameter or input.
pub fn real_start(variable: &Variable) -> Option<f64> {
    match variable.access {
        Access::Real(access) => Some(*access(&mut Parameters::default())),
        Access::Input(access) => Some(*access(&mut Inputs::default())),
        _ => None,
    }
}

/// Checks that a number is finite and within the range of its row.
pub fn check_value(row: &Variable, value: f64) -> Result<(), Problem> {
    if !value.is_finite() {
        return Err(problem!(row.name, "{value} is not a finite number"));
    }
    let Some(Range { min, max }) = row.range else { return Ok(()) };
    if (min..=max).contains(&value) {
        return Ok(());
    }
    let unit = row.unit.map_or("", |u| if u.name == "1" { "" } else { u.name });
    if let Some(only) = (Range { min, max }).only_value() {
        return Err(problem!(
            row.name,
            "{value} {unit} is not {}, the only possible value. {}",
            written_as_shown(row, only),
            row.description
        ));
    }
    let mut text = format!("{value} {unit} is outside [{min}, {max}] {unit}");
    // the most common mistake: a value in the display unit
    if let Some(shown) = row.display {
        let meant = shown.read(value);
        if (min..=max).contains(&meant) {
            let _ = write!(text, "; did you mean {value} {} = {meant:.6} {unit}?", shown.name);
        }
    }
    Err(Problem::new(row.name, text.replace("  ", " ").replace(" ;", ";").trim_end()))
}

/// Rounding error by which a value may exceed a range, relative to the larger of 1 SI unit and the last value.
const ROUNDING: f64 = 1e-9;
/// Magnitude from which the limit of an input is far beyond any differential, and fraction of such a limit beyond which
/// the last value shows that the values grow.
const FAR: f64 = 1e5;
const GROWN: f64 = 1e-2;

/// Returns the value that a variable takes if it is set to `value` after it was `last`. An input or a tunable parameter
/// that exceeds its range only by rounding is set to the limit. Fails for all other values that are out of range or not
/// finite.
pub fn accepted(row: &Variable, value: f64, last: f64) -> Result<f64, Problem> {
    let rounding = ROUNDING * last.abs().max(1.0);
    // a host may trap invalid operations, such as arithmetic with NaN, so values are compared first
    let value = match row.range.filter(|_| row.variability != Variability::Fixed) {
        Some(range) if value < range.min && range.min - value <= rounding => range.min,
        Some(range) if value > range.max && value - range.max <= rounding => range.max,
        _ => value,
    };
    check_value(row, value).map(|()| value).map_err(|problem| {
        let has_grown = row.range.is_some_and(|range| range.max >= FAR && last.abs() > GROWN * range.max);
        if row.causality != Causality::Input || !has_grown {
            return problem;
        }
        let said = problem.message.split("; did you mean").next().unwrap_or_default();
        let why = "a coupling whose values grow from step to step is unstable (docs/coupling.md)";
        problem!(row.name, "{said}; it was {last} before: {why}")
    })
}

/// Returns a problem for every parameter that is not finite or out of range.
pub fn check_ranges(parameters: &Parameters) -> Vec<Problem> {
    let mut p = *parameters;
    let checked = table().rows.iter().filter_map(|row| match row.access {
        Access::Real(access) => check_value(row, *access(&mut p)).err(),
        Access::Integer(access) => check_value(row, f64::from(*access(&mut p))).err(),
        _ => None,
    });
    checked.collect()
}

/// Returns `fixed` with the tunable parameters of `parameters`.
pub fn tuned(parameters: &Parameters, fixed: &Parameters) -> Parameters {
    let (mut from, mut to) = (*parameters, *fixed);
    for row in table().rows.iter().filter(|row| row.variability == Variability::Tunable) {
        if let Access::Real(access) = row.access {
            *access(&mut to) = *access(&mut from);
        }
    }
    to
}

/// GUID of this interface. It changes whenever a property of a row changes on which a host relies.
pub fn guid() -> &'static str {
    static GUID: OnceLock<&str> = OnceLock::new();
    GUID.get_or_init(|| {
        let mut text = String::from(super::MODEL_NAME);
        for row in table().rows {
            let _ = write!(text, "\n{} {:?} {:?}", row.name, row.causality, row.variability);
            let _ = write!(text, " {:?} {:?} {:?}", row.unit.map(|u| u.name), row.range, real_start(row));
            if row.unit.is_some_and(|unit| unit.is_relative) {
                text.push_str(" relative");
            }
            if let Access::Enumeration(kind, ..) = row.access {
                let _ = write!(text, " {kind:?}");
            }
        }
        let (a, b) = (fnv1a(text.bytes()), fnv1a(text.bytes().rev()));
        store_text(&format!(
            "{{{:08x}-{:04x}-{:04x}-{:04x}-{:012x}}}",
            a >> 32,
            (a >> 16) & 0xffff,
            a & 0xffff,
            b >> 48,
            b & 0xffff_ffff_ffff
        ))
    })
}

/// 64-bit FNV-1a hash.
pub fn fnv1a(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

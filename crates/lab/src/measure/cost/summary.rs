//! The summary: what a tolerance gives and costs, and what is cheapest for an accuracy.

use bevel_differential::model::Method;

use answers::text::numbers::significant;
use answers::text::table::Table;

use super::work_precision::{MethodResult, MethodRun, WorkPrecision, name};

/// Errors of speed that are asked for.
const WANTED: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// Errors below this are rounding.
const AT_REST: f64 = 1e-12;

/// A table with a title.
pub struct TitledTable {
    title: String,
    table: Table,
}

impl TitledTable {
    /// `table` under `title`.
    pub fn new(title: &str, table: Table) -> Self {
        Self { title: title.to_owned(), table }
    }

    /// For the terminal.
    pub fn terminal(&self) -> String {
        format!("{}\n\n{}", self.title, self.table.terminal())
    }

    /// For a document.
    pub fn markdown(&self) -> String {
        format!("{}:\n\n{}", self.title, self.table.markdown())
    }
}

/// Both tables.
pub fn tables(found: &WorkPrecision) -> [TitledTable; 2] {
    [by_tolerance(found), cheapest(found)]
}

fn measured(row: &MethodRun) -> Option<&MethodResult> {
    row.outcome.as_ref().ok()
}

/// Whether there is anything to solve: at rest, and in closed form, no tolerance makes an error.
fn is_solved(found: &WorkPrecision, case: usize) -> bool {
    let mut own = found.rows.iter().filter(|row| row.case == case && row.setting.method == Method::Adaptive);
    own.any(|row| measured(row).is_none_or(|m| m.errors[0] > AT_REST))
}

/// Default method: errors and cost by tolerance.
fn by_tolerance(found: &WorkPrecision) -> TitledTable {
    let mut tolerances: Vec<f64> = Vec::new();
    for row in found.rows.iter().filter(|row| row.setting.method == Method::Adaptive) {
        if !tolerances.contains(&row.setting.value) {
            tolerances.push(row.setting.value);
        }
    }
    let head = ["case".to_owned()].into_iter().chain(tolerances.iter().map(|t| format!("{t:.0e}")));
    let mut table = Table::new(head).all_left();
    for (i, (case, _)) in found.cases.iter().enumerate().filter(|(i, _)| is_solved(found, *i)) {
        let cell = |tolerance: &f64| {
            let row = found
                .rows
                .iter()
                .find(|row| row.case == i && row.setting.method == Method::Adaptive && row.setting.value == *tolerance);
            match row.map(measured) {
                Some(Some(m)) => {
                    format!("{:.0e} {:.0e} ×{}", m.errors[0], m.errors[1], two(m.seconds.median / found.unit(i)))
                }
                _ => "failed".into(),
            }
        };
        table.push([case.name()].into_iter().chain(tolerances.iter().map(cell)));
    }
    TitledTable {
        title: "adaptive, by solver.relative_tolerance: error of speed, error of force, time × that at 1e-6".into(),
        table,
    }
}

/// Cheapest method for an error of speed.
fn cheapest(found: &WorkPrecision) -> TitledTable {
    let head = ["case".to_owned()].into_iter().chain(WANTED.map(|w| format!("{w:.0e}")));
    let mut table = Table::new(head).all_left();
    for (i, (case, _)) in found.cases.iter().enumerate().filter(|(i, _)| is_solved(found, *i)) {
        let best = |wanted: f64, of: &dyn Fn(Method) -> bool| {
            let rows = found.rows.iter().filter(|row| row.case == i && of(row.setting.method));
            let good = rows.filter_map(|row| Some((row, measured(row)?))).filter(|(_, m)| m.errors[0] <= wanted);
            good.min_by(|a, b| a.1.seconds.median.total_cmp(&b.1.seconds.median))
        };
        let cell = |wanted: f64| {
            let Some((row, m)) = best(wanted, &|_| true) else { return "none".to_owned() };
            let unit = if row.setting.method == Method::FixedStep { " s" } else { "" };
            let chosen = format!(
                "{} {:.0e}{unit} ×{}",
                name(row.setting.method),
                row.setting.value,
                two(m.seconds.median / found.unit(i))
            );
            match best(wanted, &|method| method == Method::Adaptive) {
                Some((own, _)) if own.setting == row.setting => chosen,
                Some((_, own)) => format!("{chosen} (adaptive ×{})", two(own.seconds.median / found.unit(i))),
                None => format!("{chosen} (adaptive: none)"),
            }
        };
        table.push([case.name()].into_iter().chain(WANTED.map(cell)));
    }
    TitledTable {
        title: "cheapest for an error of speed of at most …: method, tolerance or step, time × the default's".into(),
        table,
    }
}

/// Two significant digits.
fn two(value: f64) -> String {
    significant(value, 2)
}

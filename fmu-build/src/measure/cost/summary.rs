//! The summary: what a tolerance gives and costs, and what is cheapest for an accuracy.

use bevel_differential::model::Method;

use super::work_precision::{Measured, Row, WorkPrecision, name};

/// Errors of speed that are asked for.
const WANTED: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// Errors below this are rounding.
const AT_REST: f64 = 1e-12;

/// A table with a title.
pub struct Table {
    /// What it shows.
    pub title: String,
    /// Its cells, the head first.
    pub rows: Vec<Vec<String>>,
}

/// Both tables.
pub fn tables(found: &WorkPrecision) -> [Table; 2] {
    [by_tolerance(found), cheapest(found)]
}

fn measured(row: &Row) -> Option<&Measured> {
    row.outcome.as_ref().ok()
}

/// Whether there is anything to solve: at rest, and in closed form, no tolerance makes an error.
fn is_solved(found: &WorkPrecision, case: usize) -> bool {
    let mut own = found.rows.iter().filter(|row| row.case == case && row.setting.method == Method::Adaptive);
    own.any(|row| measured(row).is_none_or(|m| m.errors[0] > AT_REST))
}

/// Default method: errors and cost by tolerance.
fn by_tolerance(found: &WorkPrecision) -> Table {
    let mut tolerances: Vec<f64> = Vec::new();
    for row in found.rows.iter().filter(|row| row.setting.method == Method::Adaptive) {
        if !tolerances.contains(&row.setting.value) {
            tolerances.push(row.setting.value);
        }
    }
    let mut rows =
        vec![["case".to_owned()].into_iter().chain(tolerances.iter().map(|t| format!("{t:.0e}"))).collect::<Vec<_>>()];
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
        rows.push([case.name()].into_iter().chain(tolerances.iter().map(cell)).collect());
    }
    Table {
        title: "adaptive, by solver.relative_tolerance: error of speed, error of force, time × that at 1e-6".into(),
        rows,
    }
}

/// Cheapest method for an error of speed.
fn cheapest(found: &WorkPrecision) -> Table {
    let mut rows = vec![["case".to_owned()].into_iter().chain(WANTED.map(|w| format!("{w:.0e}"))).collect::<Vec<_>>()];
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
        rows.push([case.name()].into_iter().chain(WANTED.map(cell)).collect());
    }
    Table {
        title: "cheapest for an error of speed of at most …: method, tolerance or step, time × the default's".into(),
        rows,
    }
}

/// Two significant digits.
pub fn two(value: f64) -> String {
    match value {
        value if !value.is_finite() => "–".into(),
        value if value >= 9.95 => format!("{value:.0}"),
        value if value >= 0.995 => format!("{value:.1}"),
        value => format!("{value:.2}"),
    }
}

impl Table {
    /// For the terminal.
    pub fn terminal(&self) -> String {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |i: usize| self.rows.iter().filter_map(|row| Some(row.get(i)?.chars().count())).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let mut out = format!("{}\n\n", self.title);
        for row in &self.rows {
            let cells = row.iter().zip(&widths).map(|(cell, w)| format!("{cell:<w$}"));
            out.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
            out.push('\n');
        }
        out
    }

    /// For a document.
    pub fn markdown(&self) -> String {
        let mut out = format!("{}:\n\n", self.title);
        for (i, row) in self.rows.iter().enumerate() {
            out.push_str(&format!("| {} |\n", row.join(" | ")));
            if i == 0 {
                out.push_str(&format!("|{}\n", "---|".repeat(row.len())));
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_aligned() {
        let rows = [["case", "×1"], ["longer", "2"]].map(|row| row.map(str::to_owned).to_vec()).to_vec();
        let table = Table { title: "t".into(), rows };
        assert_eq!(table.terminal(), "t\n\ncase    ×1\nlonger  2\n");
        assert_eq!(table.markdown(), "t:\n\n| case | ×1 |\n|---|---|\n| longer | 2 |\n");
    }

    #[test]
    fn ratios_have_two_digits() {
        assert_eq!([123.4, 1.26, 0.123, f64::NAN].map(two), ["123", "1.3", "0.12", "–"]);
    }
}

//! Tables for documents, aligned.

use super::errors::QUANTITIES;
use super::measured::{Measured, Row};

/// Facet numbers of the short table.
const SHORT: [i32; 6] = [4, 8, 16, 32, 64, 128];
/// Columns of the long table: errors by their place among [`QUANTITIES`], and heads.
const SHOWN: [(usize, &str); 7] = [
    (1, "speed, °/s"),
    (2, "on the path"),
    (3, "at corners"),
    (4, "mean force, N"),
    (8, "force ripple on the path, N"),
    (10, "TE, µm"),
    (12, "its swing, µm"),
];

/// A table in Markdown; numbers to the right.
pub fn markdown(rows: &[Vec<String>]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |i: usize| rows.iter().filter_map(|row| Some(row.get(i)?.chars().count())).max().unwrap_or(0).max(4);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut out = String::new();
    for (i, row) in rows.iter().enumerate() {
        let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, &w)| format!("{cell:>w$}")).collect();
        out.push_str(&format!("| {} |\n", cells.join(" | ")));
        if i == 0 {
            let rules: Vec<String> = widths.iter().map(|&w| format!("{}:", "-".repeat(w - 1))).collect();
            out.push_str(&format!("| {} |\n", rules.join(" | ")));
        }
    }
    out
}

/// Three significant digits, no powers of ten where a reader does not need them.
pub fn three(value: f64) -> String {
    let size = value.abs();
    match value {
        v if !v.is_finite() => "–".into(),
        v if size >= 100.0 => format!("{v:.0}"),
        v if size >= 10.0 => format!("{v:.1}"),
        v if size >= 1.0 => format!("{v:.2}"),
        v if size >= 1e-3 => format!("{v:.*}", (2 - size.log10().floor() as i32).clamp(0, 9) as usize),
        0.0 => "0".into(),
        v => format!("{v:.1e}"),
    }
}

/// Errors and cost by facets at `SMOOTHINGS[which]`.
pub fn errors(found: &Measured, which: usize) -> Vec<Vec<String>> {
    let head = ["facets", "arc, µm"].into_iter().chain(SHOWN.map(|(_, head)| head));
    let mut rows: Vec<Vec<String>> = vec![head.chain(["steps", "× tooth", "× real time"]).map(str::to_owned).collect()];
    for (&n, arc) in found.form.facets.iter().zip(&found.arcs) {
        if let Some(row) = found.solid(n, which) {
            let mut cells = vec![n.to_string(), three(1e6 * arc)];
            cells.extend(SHOWN.map(|(i, _)| three(row.errors[0][i])));
            cells.extend(cost(found, row));
            rows.push(cells);
        }
    }
    let tooth = found.tooth();
    let mut cells = vec!["tooth".to_owned(), "0".into()];
    cells.extend(SHOWN.map(|(i, _)| three(tooth.errors[1][i])));
    cells.extend(cost(found, tooth));
    rows.push(cells);
    rows
}

fn cost(found: &Measured, row: &Row) -> [String; 3] {
    [
        row.statistics.accepted.to_string(),
        three(row.seconds.median / found.tooth().seconds.median),
        three(row.real_time(&found.form)),
    ]
}

/// Observed orders between successive facet numbers at `SMOOTHINGS[which]`.
pub fn orders(found: &Measured, which: usize) -> Vec<Vec<String>> {
    let facets = found.form.facets;
    let mut head = vec!["error".to_owned(), "expected".into()];
    head.extend(facets.windows(2).map(|n| format!("{}–{}", n[0], n[1])));
    let mut rows = vec![head];
    for (i, quantity) in QUANTITIES.iter().enumerate() {
        let series = found.series(i, which);
        let mut cells = vec![quantity.name.replace('_', " "), format!("{:.0}", quantity.expected[which])];
        cells.extend(series.windows(2).map(|pair| format!("{:.1}", super::errors::order(pair[0], pair[1]))));
        rows.push(cells);
    }
    rows
}

/// What of the force's ripple is of facets.
pub fn spikes(found: &Measured) -> Vec<Vec<String>> {
    let head = [
        "facets",
        "arc, µm",
        "arc / overlap",
        "deepest point: peak / mean",
        "ripple by teeth and facets",
        "by facets alone",
        "patch: peak / mean",
        "ripple by teeth and facets",
        "by facets alone",
    ];
    let mut rows: Vec<Vec<String>> = vec![head.map(str::to_owned).to_vec()];
    let share = |row: &Row, value: f64| format!("{} N, {} %", three(value), three(100.0 * value / row.look.mean));
    let cells = |row: &Row| {
        let ratio = format!("{:.4}", row.look.peak / row.look.mean);
        [ratio, share(row, row.look.ripple), share(row, row.path_ripple)]
    };
    for (&n, arc) in found.form.facets.iter().zip(&found.arcs).filter(|(n, _)| SHORT.contains(n)) {
        if let (Some(deepest), Some(patch)) = (found.solid(n, 0), found.solid(n, 1)) {
            let mut row = vec![n.to_string(), three(1e6 * arc), format!("{} %", three(100.0 * arc / found.overlap))];
            row.extend(cells(deepest));
            row.extend(cells(patch));
            rows.push(row);
        }
    }
    let exact = cells(found.tooth());
    let mut row = vec!["exact teeth".to_owned(), "0".into(), "0".into()];
    row.extend(exact.clone());
    row.extend(exact);
    rows.push(row);
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        assert_eq!(
            [123.4, 1.234, 0.01234, 1e-5, 0.0, f64::NAN].map(three),
            ["123", "1.23", "0.0123", "1.0e-5", "0", "–"]
        );
    }

    #[test]
    fn a_table_is_aligned() {
        let rows = [["n", "error, µm"], ["128", "2"]].map(|row| row.map(str::to_owned).to_vec());
        assert_eq!(markdown(&rows), "|    n | error, µm |\n| ---: | --------: |\n|  128 |         2 |\n");
    }
}

//! The tables for docs/solids.md and docs/study.md.

use answers::text::numbers::significant;
use answers::text::table::Table;

use super::errors::QUANTITIES;
use super::results::{SolidsResults, TeethResult};

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

/// Three significant digits.
pub fn three(value: f64) -> String {
    significant(value, 3)
}

/// Errors and cost by facets at `SMOOTHINGS[which]`.
pub fn errors(found: &SolidsResults, which: usize) -> Table {
    let head = ["facets", "arc, µm"].into_iter().chain(SHOWN.map(|(_, head)| head));
    let mut table = Table::new(head.chain(["steps", "× tooth", "× real time"]));
    for (&n, arc) in found.form.facets.iter().zip(&found.arcs) {
        if let Some(row) = found.solid(n, which) {
            let mut cells = vec![n.to_string(), three(1e6 * arc)];
            cells.extend(SHOWN.map(|(i, _)| three(row.errors[0][i])));
            cells.extend(cost(found, row));
            table.push(cells);
        }
    }
    let tooth = found.tooth();
    let mut cells = vec!["tooth".to_owned(), "0".into()];
    cells.extend(SHOWN.map(|(i, _)| three(tooth.errors[1][i])));
    cells.extend(cost(found, tooth));
    table.push(cells);
    table
}

fn cost(found: &SolidsResults, row: &TeethResult) -> [String; 3] {
    [
        row.statistics.accepted.to_string(),
        three(row.seconds.median / found.tooth().seconds.median),
        three(row.real_time(&found.form)),
    ]
}

/// Observed orders between successive facet numbers at `SMOOTHINGS[which]`.
pub fn orders(found: &SolidsResults, which: usize) -> Table {
    let facets = found.form.facets;
    let mut head = vec!["error".to_owned(), "expected".into()];
    head.extend(facets.windows(2).map(|n| format!("{}–{}", n[0], n[1])));
    let mut table = Table::new(head);
    for (i, quantity) in QUANTITIES.iter().enumerate() {
        let series = found.series(i, which);
        let mut cells = vec![quantity.name.replace('_', " "), format!("{:.0}", quantity.expected[which])];
        cells.extend(series.windows(2).map(|pair| format!("{:.1}", super::errors::order(pair[0], pair[1]))));
        table.push(cells);
    }
    table
}

/// What of the force's ripple is of facets.
pub fn spikes(found: &SolidsResults) -> Table {
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
    let mut table = Table::new(head);
    let share =
        |row: &TeethResult, value: f64| format!("{} N, {} %", three(value), three(100.0 * value / row.look.mean));
    let cells = |row: &TeethResult| {
        let ratio = format!("{:.4}", row.look.peak / row.look.mean);
        [ratio, share(row, row.look.ripple), share(row, row.path_ripple)]
    };
    for (&n, arc) in found.form.facets.iter().zip(&found.arcs).filter(|(n, _)| SHORT.contains(n)) {
        if let (Some(deepest), Some(patch)) = (found.solid(n, 0), found.solid(n, 1)) {
            let mut row = vec![n.to_string(), three(1e6 * arc), format!("{} %", three(100.0 * arc / found.overlap))];
            row.extend(cells(deepest));
            row.extend(cells(patch));
            table.push(row);
        }
    }
    let exact = cells(found.tooth());
    let mut row = vec!["exact teeth".to_owned(), "0".into(), "0".into()];
    row.extend(exact.clone());
    row.extend(exact);
    table.push(row);
    table
}

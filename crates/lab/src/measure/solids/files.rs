//! The CSV files: errors and cost by facets, and one mesh cycle.

use std::fmt::Write as _;

use anyhow::Result;

use super::errors::{QUANTITIES, order};
use super::results::{SMOOTHINGS, SolidsResults, TeethResult};
use crate::measure::cost::{measure, measured_here};
use answers::text::csv_file::{number, number_or_nan};

/// Errors and cost.
pub fn errors(found: &SolidsResults) -> Result<String> {
    let mut columns = String::from(
        "teeth,facets,smoothing,arc_height_um,steps,evaluations,cpu_s,cpu_s_low,cpu_s_high,real_time,cost",
    );
    columns += ",mean_force_N,peak_force_N,ripple_N,tangential_ripple_N,mean_te_um";
    for q in QUANTITIES {
        let _ = write!(columns, ",{0}_{1},{0}_usual_{1},{0}_order", q.name, q.unit.replace('/', "_"));
    }
    let mut out = measured_here(
        &columns,
        &[
            "the study's turn; errors against exact teeth at a tolerance of 1e-9, and (usual) at 1e-6; order: from the row before",
            "force: normal forces of all planets on a side gear; te: transmission error; path: where exact teeth run evenly",
            "real_time: simulated over processor time at 1e-6; cost: processor time over that of exact teeth",
        ],
    )?;
    for row in &found.rows {
        out.push(cells(found, row))?;
    }
    out.text()
}

fn cells(found: &SolidsResults, row: &TeethResult) -> Vec<String> {
    let solid = row.teeth.0;
    let place = solid.and_then(|s| found.form.facets.iter().position(|&n| n == s.facets));
    let before = solid.zip(place).and_then(|(s, place)| {
        let coarse = *found.form.facets.get(place.checked_sub(1)?)?;
        found.solid(coarse, SMOOTHINGS.iter().position(|&v| v == s.smoothing)?)
    });
    let look = &row.look;
    let work = &row.statistics;
    let mut cells = vec![
        if solid.is_some() { "solid".into() } else { "tooth".into() },
        solid.map_or("-".into(), |s| s.facets.to_string()),
        number_or_nan(solid.map(|s| s.smoothing)),
        number_or_nan(place.and_then(|place| found.arcs.get(place).map(|arc| 1e6 * arc))),
        work.accepted.to_string(),
        work.evaluations.to_string(),
    ];
    cells.extend(measure::cells(&row.seconds).into_iter().take(3));
    let values = [
        row.real_time(&found.form),
        row.seconds.median / found.tooth().seconds.median,
        look.mean,
        look.peak,
        look.ripple,
        look.tangential,
        1e6 * look.deflection,
    ];
    cells.extend(values.map(number));
    for i in 0..QUANTITIES.len() {
        let at = before.and_then(|b| {
            let of = |row: &TeethResult| Some((f64::from(row.teeth.0?.facets), row.errors[0][i]));
            Some(order(of(b)?, of(row)?))
        });
        cells.extend([number(row.errors[0][i]), number(row.errors[1][i]), number_or_nan(at)]);
    }
    cells
}

/// The close record.
pub fn cycle(found: &SolidsResults) -> Result<String> {
    let mut out = measured_here(
        "teeth,facets,smoothing,time_s,force_N,speed_deg_s,te_um,tangential_N,pairs",
        &["left side gear, all planets; one mesh cycle at a tolerance of 1e-9"],
    )?;
    for row in &found.rows {
        let solid = row.teeth.0;
        let (facets, smoothing) = solid.map_or((0, 0.0), |s| (s.facets, s.smoothing));
        if facets > 32 {
            continue;
        }
        for p in &row.close {
            let teeth = if solid.is_some() { "solid" } else { "tooth" };
            let numbers = [
                format!("{:.4}", p.time),
                format!("{:.3}", p.force[0]),
                format!("{:.5}", p.speed[0]),
                format!("{:.4}", 1e6 * p.error[0]),
                format!("{:.4}", p.tangential[0]),
                p.pairs[0].to_string(),
            ];
            out.push([teeth.to_owned(), facets.to_string(), smoothing.to_string()].into_iter().chain(numbers))?;
        }
    }
    out.text()
}

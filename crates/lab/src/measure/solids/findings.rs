//! What the numbers say, in sentences.

use super::errors::fitted;
use super::results::{SolidsResults, TeethResult};
use super::tables::three;

/// Facets from which an order is fitted: coarser ones are not yet in the range where one term dominates.
const FINE: f64 = 16.0;

fn percent(part: f64, whole: f64) -> String {
    three(100.0 * part / whole)
}

/// Orders fitted from [`FINE`] on, of the deepest point and of the patch.
fn orders(found: &SolidsResults, quantity: usize) -> [String; 2] {
    [0, 1].map(|which| {
        let fine: Vec<(f64, f64)> = found.series(quantity, which).into_iter().filter(|(n, _)| *n >= FINE).collect();
        if fine.len() < 2 { "–".into() } else { format!("{:.1}", fitted(&fine)) }
    })
}

fn ordered(found: &SolidsResults, quantity: usize, what: &str) -> String {
    let [deepest, patch] = orders(found, quantity);
    format!("{what} {deepest} and {patch}")
}

/// Sentences for docs/solids.md, each an item of a list.
pub fn page(found: &SolidsResults) -> String {
    let parts = [
        ordered(found, 10, "transmission error"),
        ordered(found, 12, "its swing"),
        ordered(found, 4, "mean force"),
        ordered(found, 8, "force ripple on the path"),
        ordered(found, 2, "speed on the path"),
        ordered(found, 3, "speed at tip corners"),
        ordered(found, 0, "largest error of speed"),
    ];
    let mut out = format!(
        "- Observed orders in 1/facets, fitted from {FINE:.0} facets on, deepest point and patch: {}.\n",
        parts.join("; ")
    );
    for n in [32, 128] {
        if let (Some(deepest), Some(patch)) = (found.solid(n, 0), found.solid(n, 1)) {
            out.push_str(&at(found, n, [deepest, patch]));
        }
    }
    let exact = found.tooth();
    out.push_str(&format!(
        "- Integration hides nothing: exact teeth at the usual tolerance of 1e-6 are {} °/s (rms) and {} N of the mean force \
         from those at 1e-9.\n",
        three(exact.errors[1][1]),
        three(exact.errors[1][4])
    ));
    out
}

fn at(found: &SolidsResults, n: i32, both: [&TeethResult; 2]) -> String {
    let mean = found.tooth().look.mean;
    let report = |row: &TeethResult| {
        let e = &row.errors[0];
        format!(
            "speed {} °/s at most and {} rms, mean force {} %, transmission error {} µm with {} µm of swing (rms), {} × the time of exact teeth, {} × real time",
            three(e[0]),
            three(e[1]),
            percent(e[4], mean),
            three(e[10]),
            three(e[12]),
            three(row.seconds.median / found.tooth().seconds.median),
            three(row.real_time(&found.form)),
        )
    };
    format!("- {n} facets. Deepest point: {}. Patch: {}.\n", report(both[0]), report(both[1]))
}

/// Sentences under the table of docs/study.md.
pub fn study(found: &SolidsResults) -> String {
    let tooth = &found.tooth().look;
    let mut out = format!(
        "Exact teeth alone swing by {} N, {} % of the mean of {:.0} N, where tip corners take load over or hand it on. \
         At the study's load one pair that carries alone overlaps by {} mm by the study's K.",
        three(tooth.ripple),
        percent(tooth.ripple, tooth.mean),
        tooth.mean,
        three(1e3 * found.overlap)
    );
    let first = found.form.facets.first().and_then(|&n| Some((n, *found.arcs.first()?)));
    let last = found.form.facets.last().and_then(|&n| Some((n, *found.arcs.last()?)));
    for (n, arc) in first.into_iter().chain(last) {
        let (deepest, patch) = (found.solid(n, 0), found.solid(n, 1));
        if let (Some(deepest), Some(patch)) = (deepest, patch) {
            out.push_str(&format!(
                " With {n} facets per flank the arcs rise {} µm over the facets of both flanks, {} % of that; facets alone move \
                 the force by {} % (deepest point) or {} % (patch).",
                three(1e6 * arc),
                percent(arc, found.overlap),
                percent(deepest.path_ripple, deepest.look.mean),
                percent(patch.path_ripple, patch.look.mean)
            ));
        }
    }
    let worst = found.rows.iter().map(|row| row.look.tangential).fold(0.0, f64::max);
    out.push_str(&format!(
        " The study's own quantity, T/r_p, shows next to nothing of this: the load is constant and the gears are light, so that it \
         moves by {} N at most, whatever the facets.",
        three(worst)
    ));
    out
}

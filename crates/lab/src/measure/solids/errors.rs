//! What facets make wrong: a record compared with that of teeth on the path of contact.
//!
//! On the path of contact, away from tip corners, involutes turn each other evenly: speed and force stand still, and what
//! moves there is of the facets alone. Where a tip corner takes load over, the teeth themselves move, and facets
//! change when and how. So differences are counted together and in both parts.

use std::collections::HashSet;

use super::run::TeethPoint;

/// Speeds nearer than this to Willis' equation are those of a contact on the path alone [deg/s].
const EVEN: f64 = 1e-3;

/// Quantities whose error is reported: name in files, unit, and the order in 1/facets expected with the deepest point alone and
/// with the patch.
pub const QUANTITIES: [Quantity; 13] = [
    Quantity { name: "speed_max", unit: "deg/s", expected: [1.0, 1.0] },
    Quantity { name: "speed_rms", unit: "deg/s", expected: [1.0, 1.0] },
    Quantity { name: "speed_path_rms", unit: "deg/s", expected: [1.0, 1.0] },
    Quantity { name: "speed_corner_rms", unit: "deg/s", expected: [1.0, 1.0] },
    Quantity { name: "force_mean", unit: "N", expected: [2.0, 2.0] },
    Quantity { name: "force_peak", unit: "N", expected: [1.0, 1.0] },
    Quantity { name: "force_max", unit: "N", expected: [1.0, 1.0] },
    Quantity { name: "force_rms", unit: "N", expected: [1.0, 1.0] },
    Quantity { name: "force_path_ripple", unit: "N", expected: [1.0, 1.0] },
    Quantity { name: "te_max", unit: "um", expected: [2.0, 2.0] },
    Quantity { name: "te_rms", unit: "um", expected: [2.0, 2.0] },
    Quantity { name: "te_swing_max", unit: "um", expected: [2.0, 2.0] },
    Quantity { name: "te_swing_rms", unit: "um", expected: [2.0, 2.0] },
];

/// A quantity.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    /// Its name in files.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Orders expected of the deepest point and of the patch.
    pub expected: [f64; 2],
}

/// Errors of one record, in the order of [`QUANTITIES`].
pub type Errors = [f64; QUANTITIES.len()];

/// Forces and deflection of the left side gear in a record.
#[derive(Clone, Copy, Debug, Default)]
pub struct ForceSummary {
    /// Mean normal force [N].
    pub mean: f64,
    /// Largest [N].
    pub peak: f64,
    /// Largest less smallest [N].
    pub ripple: f64,
    /// The same of T/r_p [N].
    pub tangential: f64,
    /// Mean transmission error [m].
    pub deflection: f64,
}

/// Largest and root mean square of `values`.
fn size(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (most, sum, count) =
        values.fold((0.0f64, 0.0, 0.0), |(most, sum, count), v| (most.max(v.abs()), sum + v * v, count + 1.0));
    [most, if count > 0.0 { f64::sqrt(sum / count) } else { f64::NAN }]
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
    sum / count
}

/// Stretches of the record of `exact` teeth, of side `s`, in which they run evenly at speeds `willis`: the middle half of
/// each, as what happens at a corner reaches some way onto the path where contact is spread over a patch.
fn on_path(exact: &[TeethPoint], s: usize, willis: [f64; 2]) -> Vec<Vec<usize>> {
    let even = |p: &TeethPoint| (p.speed[s] - willis[s]).abs() < EVEN;
    let mut stretches: Vec<Vec<usize>> = Vec::new();
    for (i, p) in exact.iter().enumerate().filter(|(_, p)| even(p)) {
        match stretches.last_mut() {
            Some(last) if last.last().is_some_and(|&l| l + 1 == i && exact[l].pairs[s] == p.pairs[s]) => last.push(i),
            _ => stretches.push(vec![i]),
        }
    }
    for stretch in &mut stretches {
        let ends = [stretch.first(), stretch.last()].map(|i| i.map_or(f64::NAN, |&i| exact[i].time));
        let (middle, quarter) = (0.5 * (ends[0] + ends[1]), 0.25 * (ends[1] - ends[0]));
        stretch.retain(|&i| (exact[i].time - middle).abs() <= quarter);
    }
    stretches
}

/// Errors of `points` against `exact`, both with close records from `close` on; `willis` are speeds of gears without play.
pub fn errors(points: &[TeethPoint], exact: &[TeethPoint], close: f64, willis: [f64; 2]) -> Errors {
    let at_points: Vec<(&TeethPoint, &TeethPoint)> = points.iter().zip(exact).filter(|(p, _)| p.communicates).collect();
    let both = |of: &dyn Fn(&TeethPoint, usize) -> f64| -> Vec<f64> {
        [0, 1].iter().flat_map(|&s| at_points.iter().map(move |(p, e)| of(p, s) - of(e, s))).collect()
    };
    let mut apart = [Vec::new(), Vec::new()];
    for s in 0..2 {
        let even: HashSet<usize> = on_path(exact, s, willis).into_iter().flatten().collect();
        for (i, (p, e)) in points.iter().zip(exact).enumerate().filter(|(_, (p, _))| p.communicates) {
            apart[usize::from(!even.contains(&i))].push(p.speed[s] - e.speed[s]);
        }
    }
    let [path, corner] = apart.map(|values| size(values.into_iter())[1]);
    let speed = size(both(&|p, s| p.speed[s]).into_iter());
    let force = size(both(&|p, s| p.force[s]).into_iter());
    let deflection = both(&|p, s| 1e6 * p.error[s]);
    let middle = mean(deflection.iter().copied());
    let te = size(deflection.iter().copied());
    let swing = size(deflection.iter().map(|d| d - middle));
    let (here, there) = (look(points, close), look(exact, close));
    let force_mean = mean(both(&|p, s| p.force[s]).into_iter()).abs();
    let peak = (here.peak - there.peak).abs();
    [
        speed[0],
        speed[1],
        path,
        corner,
        force_mean,
        peak,
        force[0],
        force[1],
        path_ripple(points, exact, close, willis),
        te[0],
        te[1],
        swing[0],
        swing[1],
    ]
}

/// What the close part of a record shows of the left side gear.
pub fn look(points: &[TeethPoint], close: f64) -> ForceSummary {
    let own = || points.iter().filter(|p| p.time > close);
    let range = |of: fn(&TeethPoint) -> f64| {
        own().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    };
    let [[low, high], [least, most]] = [range(|p| p.force[0]), range(|p| p.tangential[0])];
    ForceSummary {
        mean: mean(own().map(|p| p.force[0])),
        peak: high,
        ripple: high - low,
        tangential: most - least,
        deflection: mean(own().map(|p| p.error[0])),
    }
}

/// What facets alone make of the left side gear's force: its greatest distance from the mean of the stretch on the path of
/// contact, where the force of exact teeth stands still [N].
pub fn path_ripple(points: &[TeethPoint], exact: &[TeethPoint], close: f64, willis: [f64; 2]) -> f64 {
    let mut worst = 0.0f64;
    for stretch in on_path(exact, 0, willis) {
        let forces: Vec<f64> =
            stretch.iter().filter(|&&i| exact[i].time > close).map(|&i| points[i].force[0]).collect();
        let middle = mean(forces.iter().copied());
        worst = forces.iter().fold(worst, |worst, f| worst.max((f - middle).abs()));
    }
    worst
}

/// Order in 1/facets between two facet numbers.
pub fn order(coarse: (f64, f64), fine: (f64, f64)) -> f64 {
    (coarse.1 / fine.1).ln() / (fine.0 / coarse.0).ln()
}

/// Order in 1/facets through all of `pairs` of facets and error: least squares of the logarithms.
pub fn fitted(pairs: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = pairs.iter().map(|(n, e)| (n.ln(), e.ln())).collect();
    let (x, y) = (mean(logs.iter().map(|l| l.0)), mean(logs.iter().map(|l| l.1)));
    let (xy, xx) = logs.iter().fold((0.0, 0.0), |(xy, xx), l| (xy + (l.0 - x) * (l.1 - y), xx + (l.0 - x).powi(2)));
    -xy / xx
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(i: usize, speed: f64, force: f64) -> TeethPoint {
        TeethPoint {
            time: 1.0 + i as f64,
            communicates: true,
            speed: [speed; 2],
            force: [force; 2],
            pairs: [1.0; 2],
            ..TeethPoint::default()
        }
    }

    #[test]
    fn errors_are_parted_by_where_exact_teeth_run_evenly() {
        let series = |values: &[(f64, f64)]| -> Vec<TeethPoint> {
            values.iter().enumerate().map(|(i, v)| point(i, v.0, v.1)).collect()
        };
        let exact = series(&[(10.0, 100.0), (10.0, 100.0), (10.0, 100.0), (10.0, 100.0), (10.0, 100.0), (12.0, 100.0)]);
        let found = series(&[(11.0, 90.0), (10.5, 101.0), (10.5, 102.0), (10.5, 103.0), (11.0, 90.0), (13.0, 140.0)]);
        let errors = errors(&found, &exact, 0.0, [10.0; 2]);
        // the middle half of the even stretch, and all else
        assert_eq!((errors[0], errors[2], errors[3], errors[8]), (1.0, 0.5, 1.0, 1.0));
        assert_eq!(look(&found, 0.0).ripple, 50.0);
    }

    #[test]
    fn orders_are_slopes() {
        let pairs = [4.0, 8.0, 32.0].map(|n: f64| (n, 3.0 / (n * n)));
        assert!((fitted(&pairs) - 2.0).abs() < 1e-12);
        assert!((order(pairs[0], pairs[2]) - 2.0).abs() < 1e-12);
    }
}

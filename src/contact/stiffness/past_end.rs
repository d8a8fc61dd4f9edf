//! Compliance of a tooth pair past an end of the path, as a function of the distance x from that end. Along the range
//! in which a tip corner can touch, it is the compliance at the corner, except for a short blend at the end of the
//! path. Beyond this range, or without a corner, it levels off to a constant.
//!
//! The corner moves up its mate's flank from an arc ρ₀ [rad] at x = 0, and ρ² grows about linearly with x. If ρ₀ is
//! small because the corner is near the mate's base circle, most curvature of the Hertz part is within x ≈ ρ₀². The
//! knots of the nearer half are therefore evenly spaced in the eighth root of x + ρ₀². In the farther half, the knots
//! cluster quadratically at the far end, because the mate's tooth is thin there.
//!
//! At the end of the path, the slope of the exact compliance jumps. Past the end, the load on the corner's own tooth
//! stays at the tip, and the load on the mate's flank reverses its direction of travel. The table therefore blends the
//! parabola of the path into the compliance of the corner over a short distance, with a smooth step whose first four
//! derivatives are continuous.

use super::spline::{Cell, cells, cubic};
use crate::numeric::{Jet, sqrt};

/// Number of cells of each half.
const CELLS: usize = 512;
/// Largest relative change of the value while it levels off. It limits the contributions of the slope and of the
/// curvature separately.
const LEVEL_CHANGE: f64 = 0.125;
/// Step of the differences for the slopes at both ends, as a fraction of the cell at the end.
const END_STEP: f64 = 0.25;

/// Range past the end of the path on which a tip corner touches.
#[derive(Clone, Copy, Debug)]
pub struct CornerRange {
    /// Distance over which the slope changes from that of the path to that of the corner [rad].
    pub turn: f64,
    /// Length of the range [rad].
    pub length: f64,
    /// Square of the mate's arc ρ₀ at the end of the path [rad²].
    pub mate_arc_squared: f64,
}

/// Continuation of the compliance past an end of the path.
#[derive(Clone, Debug)]
pub struct PastEnd {
    corner: Option<CornerTable>,
    length: f64,
    level: Level,
}

#[derive(Clone, Debug)]
struct CornerTable {
    /// Value and outward derivatives at the end of the path, which define a parabola.
    end: Jet,
    /// Distance up to which this parabola is blended into the compliance of the corner [rad].
    turn: f64,
    /// Distance at which the halves meet [rad].
    middle: f64,
    /// Distance at which the table ends [rad].
    length: f64,
    /// ρ₀² [rad²].
    mate_arc_squared: f64,
    /// Eighth root of ρ₀².
    first_eighth_root: f64,
    /// Number of cells of the nearer half per unit of the eighth root.
    per_eighth_root: f64,
    /// Number of cells of the farther half over the square root of its length.
    cells_per_sqrt: f64,
    cells: Box<[Cell; 2 * CELLS]>,
}

/// Continuation from the value, slope and curvature at an end to a constant.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// Value at the end, with outward derivatives.
    end: Jet,
    /// Distance at which the function becomes constant.
    length: f64,
}

impl Level {
    fn new(end: Jet, length: f64) -> Self {
        // over the whole length, `at` adds length/2 times the slope and length²/12 times the curvature to the value
        let by_slope = 2.0 * LEVEL_CHANGE * end.v / end.d.abs();
        let by_curvature = sqrt(12.0 * LEVEL_CHANGE * end.v / end.dd.abs());
        Self { end, length: length.min(by_slope).min(by_curvature) }
    }

    fn at(&self, x: f64) -> Jet {
        let (e, l) = (self.end, self.length);
        let u = (x / l).min(1.0);
        let v = 1.0 - u;
        // with u = x/length, the slope at the end has the weight (1−u)²(1+2u) in the slope at u, and the curvature at
        // the end has the weight u(1−u)²; both weights and their derivatives vanish at u = 1
        let slope = [u * (1.0 - u * u * (1.0 - 0.5 * u)), v * v * (1.0 + 2.0 * u), -6.0 * u * v];
        let bend = [u * u * (0.5 - u * (2.0 / 3.0 - 0.25 * u)), u * v * v, v * (1.0 - 3.0 * u)];
        Jet {
            v: e.v + l * (e.d * slope[0] + l * e.dd * bend[0]),
            d: e.d * slope[1] + l * e.dd * bend[1],
            dd: e.d / l * slope[2] + e.dd * bend[2],
        }
    }
}

/// The smooth step u⁵(126 − 420u + 540u² − 315u³ + 70u⁴) from 0 to 1, u = x/`length`.
fn smooth_step(x: f64, length: f64) -> Jet {
    let u = x / length;
    let (v, uu) = (1.0 - u, u * u);
    let steep = uu * v * v;
    Jet {
        v: uu * uu * u * (126.0 - u * (420.0 - u * (540.0 - u * (315.0 - 70.0 * u)))),
        d: 630.0 * steep * steep / length,
        dd: 2520.0 * steep * u * v * (v - u) / (length * length),
    }
}

impl CornerTable {
    fn new(part: &CornerRange, end: Jet, f: impl Fn(f64) -> f64) -> Self {
        let CornerRange { turn, length, mate_arc_squared } = *part;
        let middle = 0.5 * length;
        let (first_eighth_root, last) = (eighth_root(mate_arc_squared), eighth_root(middle + mate_arc_squared));
        let per_cell = (last - first_eighth_root) / CELLS as f64;
        let share = |j: usize| j as f64 / CELLS as f64;
        let near =
            (1..CELLS).map(|j| square(square(square(first_eighth_root + per_cell * j as f64))) - mate_arc_squared);
        let far = (1..CELLS).map(|j| length - (length - middle) * square(1.0 - share(j)));
        let knots: Vec<f64> = [0.0].into_iter().chain(near).chain([middle]).chain(far).chain([length]).collect();
        let values: Vec<f64> = knots.iter().map(|&x| f(x)).collect();
        // one-sided differences of fourth order, because the function is unknown beyond its ends
        let slope = |x: f64, step: f64| {
            let sum = -25.0 * f(x) + 48.0 * f(x + step) - 36.0 * f(x + 2.0 * step) + 16.0 * f(x + 3.0 * step);
            (sum - 3.0 * f(x + 4.0 * step)) / (12.0 * step)
        };
        let steps = [knots[1], knots[2 * CELLS - 1] - length].map(|cell| END_STEP * cell);
        let cells = cells(&knots, &values, [slope(0.0, steps[0]), slope(length, steps[1])]);
        Self {
            end,
            turn,
            middle,
            length,
            mate_arc_squared,
            first_eighth_root,
            per_eighth_root: 1.0 / per_cell,
            cells_per_sqrt: CELLS as f64 / sqrt(length - middle),
            cells,
        }
    }

    #[inline]
    fn at(&self, x: f64) -> Jet {
        let cell = if x < self.middle {
            (self.per_eighth_root * (eighth_root(x + self.mate_arc_squared) - self.first_eighth_root)) as usize
        } else {
            2 * CELLS - 1 - (self.cells_per_sqrt * sqrt(self.length - x)) as usize
        };
        // rounding may select the neighbouring cell, but both cubics agree at the knot
        let corner = cubic(&self.cells[cell.min(2 * CELLS - 1)], x);
        if x < self.turn { self.turning(x, corner) } else { corner }
    }

    /// Blends the path's parabola with the corner's value `corner` for `x` < `turn`.
    fn turning(&self, x: f64, corner: Jet) -> Jet {
        let (end, step) = (&self.end, smooth_step(x, self.turn));
        let path = Jet { v: end.v + x * (end.d + 0.5 * x * end.dd), d: end.d + x * end.dd, dd: end.dd };
        let (v, d, dd) = (corner.v - path.v, corner.d - path.d, corner.dd - path.dd);
        Jet {
            v: path.v + v * step.v,
            d: path.d + d * step.v + v * step.d,
            dd: path.dd + dd * step.v + 2.0 * d * step.d + v * step.dd,
        }
    }
}

fn square(x: f64) -> f64 {
    x * x
}

fn eighth_root(x: f64) -> f64 {
    sqrt(sqrt(sqrt(x)))
}

impl PastEnd {
    /// Returns a continuation with two ranges. Along the corner range `part`, it is the positive compliance `f` of a
    /// tip corner. Beyond, it levels off to a constant within the distance `level` [rad]. `end` contains the value and
    /// outward derivatives at the end of the path.
    pub fn along_corner(part: &CornerRange, end: Jet, level: f64, f: impl Fn(f64) -> f64) -> Self {
        let table = CornerTable::new(part, end, f);
        let last = cubic(&table.cells[2 * CELLS - 1], part.length);
        Self { corner: Some(table), length: part.length, level: Level::new(last, level) }
    }

    /// Returns a continuation without a corner. It levels off from the value and outward derivatives `end` to a
    /// constant within the distance `level` [rad].
    pub fn levelling_off(end: Jet, level: f64) -> Self {
        Self { corner: None, length: 0.0, level: Level::new(end, level) }
    }

    /// Value with outward derivatives at the distance `x` ≥ 0.
    #[inline]
    pub fn at(&self, x: f64) -> Jet {
        match &self.corner {
            Some(table) if x < self.length => table.at(x),
            _ => self.level.at(x - self.length),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PART: CornerRange = CornerRange { turn: 1e-3, length: 0.3, mate_arc_squared: 0.03 };
    /// Value and derivatives at the end of a path, for the function below.
    const END: Jet = Jet { v: 6.873, d: 1.0, dd: -3.0 };

    /// A compliance like that of a corner. The mate's arc grows as √(x + `mate_arc_squared`), and Hertz's logarithm has
    /// its pole at zero arc. The logarithm of a pointed tooth has its pole a little past the end.
    fn function(mate_arc_squared: f64) -> impl Fn(f64) -> f64 {
        move |x: f64| {
            5.0 - 0.5 * libm::log(x + mate_arc_squared) - 0.1 * libm::log(0.302 - x) + crate::numeric::sin(4.0 * x)
        }
    }

    #[test]
    fn slope_and_curvature_of_a_level_match_its_values() {
        let level = Level::new(END, 0.3);
        for k in 1..100 {
            let (x, h) = (0.01 * f64::from(k) * level.length, 1e-5 * level.length);
            let [before, at, after] = [x - h, x, x + h].map(|x| level.at(x));
            let [slope, curvature] = [after.v - before.v, after.d - before.d].map(|change| change / (2.0 * h));
            assert!((at.d - slope).abs() < 1e-6 * END.d.abs(), "{x}: {} {slope}", at.d);
            assert!((at.dd - curvature).abs() < 1e-5 * (END.d / level.length).abs(), "{x}: {} {curvature}", at.dd);
        }
    }

    #[test]
    fn the_table_follows_a_corner_far_from_and_near_its_mate_s_base_circle() {
        for mate_arc_squared in [0.03, 2e-4, 8e-7] {
            let (f, part) = (function(mate_arc_squared), CornerRange { mate_arc_squared, ..PART });
            let past_end = PastEnd::along_corner(&part, END, 0.1, &f);
            let mut worst = 0f64;
            for j in 0..=20_000 {
                let share = 0.5 - 0.5 * (f64::from(j) * std::f64::consts::PI / 20_000.0).cos();
                let x = part.turn + (part.length - part.turn) * share;
                worst = worst.max((past_end.at(x).v / f(x) - 1.0).abs());
            }
            println!("{mate_arc_squared:e}: {worst:e}");
            assert!(worst < 1e-9, "{mate_arc_squared:e}: {worst:e}");
        }
    }

    #[test]
    fn value_slope_and_curvature_have_no_jumps() {
        let past_end = PastEnd::along_corner(&PART, END, 0.1, function(PART.mate_arc_squared));
        assert_eq!(past_end.at(0.0), END);
        for x in [PART.turn, 0.5 * (PART.turn + PART.length), PART.length] {
            let (a, b) = (past_end.at(x * (1.0 - 1e-14)), past_end.at(x));
            assert!((a.v - b.v).abs() < 1e-12 && (a.d - b.d).abs() < 1e-9 * b.d.abs(), "{x}: {a:?} {b:?}");
            assert!((a.dd - b.dd).abs() < 1e-5 * b.dd.abs(), "{x}: {a:?} {b:?}");
        }
        for (length, h) in [(PART.turn, 1e-8), (PART.length + 0.11, 1e-7)] {
            for j in 0..2000 {
                let x = length * (f64::from(j) + 0.5) / 2000.0;
                let (m, c, p) = (past_end.at(x - h), past_end.at(x), past_end.at(x + h));
                let scale = c.d.abs() + h * c.dd.abs() + 1.0;
                assert!((c.d - (p.v - m.v) / (2.0 * h)).abs() < 1e-4 * scale, "{x}: {c:?} {m:?} {p:?}");
                let scale = c.dd.abs() + c.d.abs() / length + 1.0;
                assert!((c.dd - (p.d - m.d) / (2.0 * h)).abs() < 2e-3 * scale, "{x}: {c:?} {m:?} {p:?}");
            }
        }
    }

    #[test]
    fn without_a_corner_the_function_levels_off_within_the_given_distance() {
        let past_end = PastEnd::levelling_off(END, 0.1);
        assert_eq!(past_end.at(0.0), END);
        let (before, level) = (past_end.at(0.0999), past_end.at(0.1));
        assert!(before.d != 0.0 && before.dd != 0.0);
        assert_eq!((level.v, level.d, level.dd), (past_end.at(1e3).v, 0.0, 0.0));
    }
}

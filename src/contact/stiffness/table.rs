//! A function of the place on the path as a cubic spline, twice continuously differentiable and read in O(1).
//!
//! Toward a clipped end of the path the Hertz part has a logarithm and toward a pointed tip the bending has one, so in
//! the outer quarters the knots close in quadratically on the ends: index = n √(distance). The middle half is even, and
//! cells meet with like widths. Past its ends the function continues as a quartic with the end's value, slope and
//! curvature, and is constant from a short distance on.

use crate::numeric::{Jet, sqrt};

/// Cells in each outer quarter and in the middle half.
const CELLS: usize = 256;

/// Largest change past an end as a share of the value there, for each of slope and curvature.
const TAIL_CHANGE: f64 = 0.125;

/// A cell: its first knot, and the coefficients of the cubic in the distance from it.
type Cell = [f64; 5];

/// Compliance along the path of contact.
#[derive(Clone, Debug)]
pub struct ComplianceTable {
    low: f64,
    high: f64,
    /// Length of an outer quarter, and index per √length and per length.
    quarter: f64,
    per_root: f64,
    per_length: f64,
    cells: Box<[Cell; 3 * CELLS]>,
    tails: [Tail; 2],
}

/// Continuation past an end.
#[derive(Clone, Copy, Debug)]
struct Tail {
    /// Value at the end with derivatives outward.
    end: Jet,
    /// Distance at which the function becomes constant.
    length: f64,
}

impl Tail {
    fn new(end: Jet, length: f64) -> Self {
        // at most half the slope and a twelfth of the curvature are added up, see `at`
        let by_slope = 2.0 * TAIL_CHANGE * end.v / end.d.abs();
        let by_curvature = sqrt(12.0 * TAIL_CHANGE * end.v / end.dd.abs());
        Self { end, length: length.min(by_slope).min(by_curvature) }
    }

    fn at(&self, x: f64) -> Jet {
        let (e, l) = (self.end, self.length);
        let u = (x / l).min(1.0);
        let v = 1.0 - u;
        // f′ = (1−u)²(1+2u) carries the slope, u(1−u)² the curvature; both end flat
        let slope = [u * (1.0 - u * u * (1.0 - 0.5 * u)), v * v * (1.0 + 2.0 * u), -6.0 * u * v];
        let bend = [u * u * (0.5 - u * (2.0 / 3.0 - 0.25 * u)), u * v * v, v * (1.0 - 3.0 * u)];
        Jet {
            v: e.v + l * (e.d * slope[0] + l * e.dd * bend[0]),
            d: e.d * slope[1] + l * e.dd * bend[1],
            dd: e.d / l * slope[2] + e.dd * bend[2],
        }
    }
}

impl ComplianceTable {
    /// Table of the positive function `f` on [`low`, `high`], constant from `tail` past the ends on.
    pub fn new(low: f64, high: f64, tail: f64, f: impl Fn(f64) -> f64) -> Self {
        let span = high - low;
        let knots: Vec<f64> = (0..=3 * CELLS).map(|j| low + span * share(j)).collect();
        let values: Vec<f64> = knots.iter().map(|&s| f(s)).collect();
        // slopes at the ends by differences of fourth order: the function is known a little past them
        let step = END_STEP * span;
        let slope =
            |s: f64| (8.0 * (f(s + step) - f(s - step)) - (f(s + 2.0 * step) - f(s - 2.0 * step))) / (12.0 * step);
        let second = second_derivatives(&knots, &values, [slope(low), slope(high)]);
        let mut cells = Box::new([[0.0; 5]; 3 * CELLS]);
        for (j, cell) in cells.iter_mut().enumerate() {
            let h = knots[j + 1] - knots[j];
            let (a, b) = (second[j], second[j + 1]);
            let rise = (values[j + 1] - values[j]) / h;
            *cell = [knots[j], values[j], rise - h * (2.0 * a + b) / 6.0, 0.5 * a, (b - a) / (6.0 * h)];
        }
        let first = cubic(&cells[0], low);
        let last = cubic(&cells[3 * CELLS - 1], high);
        let quarter = 0.25 * span;
        Self {
            low,
            high,
            quarter,
            per_root: CELLS as f64 / sqrt(quarter),
            per_length: CELLS as f64 / (2.0 * quarter),
            cells,
            tails: [Tail::new(Jet { d: -first.d, ..first }, tail), Tail::new(last, tail)],
        }
    }

    /// Value with derivatives at `s`, any finite number.
    #[inline]
    pub fn at(&self, s: f64) -> Jet {
        let (above, below) = (s - self.low, self.high - s);
        let cell = if above < self.quarter {
            if above < 0.0 {
                let mirrored = self.tails[0].at(-above);
                return Jet { d: -mirrored.d, ..mirrored };
            }
            (self.per_root * sqrt(above)) as usize
        } else if below < self.quarter {
            if below < 0.0 {
                return self.tails[1].at(-below);
            }
            3 * CELLS - 1 - (self.per_root * sqrt(below)) as usize
        } else {
            CELLS + (self.per_length * (above - self.quarter)) as usize
        };
        // rounding may name a neighbour, whose cubic is the same there
        cubic(&self.cells[cell.min(3 * CELLS - 1)], s)
    }
}

/// Step of the end slopes' differences as a share of the table's length.
const END_STEP: f64 = 1e-4;

/// Where knot `j` stands between the ends.
fn share(j: usize) -> f64 {
    let part = |k: usize| k as f64 / CELLS as f64;
    if j <= CELLS {
        0.25 * part(j) * part(j)
    } else if j < 2 * CELLS {
        0.25 + 0.5 * part(j - CELLS)
    } else {
        1.0 - 0.25 * part(3 * CELLS - j) * part(3 * CELLS - j)
    }
}

#[inline]
fn cubic(c: &Cell, s: f64) -> Jet {
    let x = s - c[0];
    Jet {
        v: c[1] + x * (c[2] + x * (c[3] + x * c[4])),
        d: c[2] + x * (2.0 * c[3] + x * 3.0 * c[4]),
        dd: 2.0 * c[3] + x * 6.0 * c[4],
    }
}

/// Second derivatives at the knots of the cubic spline with the given slopes at its ends.
fn second_derivatives(knots: &[f64], values: &[f64], slope: [f64; 2]) -> Vec<f64> {
    let n = knots.len() - 1;
    let h = |i: usize| knots[i + 1] - knots[i];
    let rise = |i: usize| (values[i + 1] - values[i]) / h(i);
    // rows h₋ M₋ + 2(h₋ + h₊) M + h₊ M₊ = 6 (rise₊ − rise₋), eliminated downward
    let (mut diagonal, mut right) = (vec![0.0; n + 1], vec![0.0; n + 1]);
    (diagonal[0], right[0]) = (2.0 * h(0), 6.0 * (rise(0) - slope[0]));
    for i in 1..=n {
        let (width, target) =
            if i < n { (h(i - 1) + h(i), rise(i) - rise(i - 1)) } else { (h(n - 1), slope[1] - rise(n - 1)) };
        let factor = h(i - 1) / diagonal[i - 1];
        diagonal[i] = 2.0 * width - factor * h(i - 1);
        right[i] = 6.0 * target - factor * right[i - 1];
    }
    let mut second = vec![0.0; n + 1];
    second[n] = right[n] / diagonal[n];
    for i in (0..n).rev() {
        second[i] = (right[i] - h(i) * second[i + 1]) / diagonal[i];
    }
    second
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A logarithm whose pole lies as near to the end as that of a clipped path.
    fn function(s: f64) -> f64 {
        5.0 - libm::log(s + 0.504) + crate::numeric::sin(2.0 * s)
    }

    #[test]
    fn a_logarithm_near_the_end_is_met_within_a_millionth() {
        let table = ComplianceTable::new(-0.5, 1.0, 0.1, function);
        let mut worst = 0f64;
        for j in 0..=10_000 {
            let s = -0.5 + 1.5e-4 * f64::from(j);
            worst = worst.max((table.at(s).v / function(s) - 1.0).abs());
        }
        assert!(worst < 1e-6, "{worst:e}");
    }

    #[test]
    fn value_slope_and_curvature_have_no_jumps_and_the_tails_level_out() {
        let table = ComplianceTable::new(-0.5, 1.0, 0.1, function);
        let close = |a: Jet, b: Jet| {
            (a.v - b.v).abs() < 1e-8
                && (a.d - b.d).abs() < 1e-6 * (1.0 + a.d.abs())
                && (a.dd - b.dd).abs() < 1e-3 * (1.0 + a.dd.abs())
        };
        for j in 0..=3 * CELLS {
            let s = -0.5 + 1.5 * share(j);
            let (left, right) = (table.at(s - 1e-12), table.at(s + 1e-12));
            assert!(close(left, right), "{s}: {left:?} {right:?}");
        }
        for s in [-0.7, 1.2] {
            let (far, further) = (table.at(s), table.at(10.0 * s));
            assert_eq!((far.d, far.dd), (0.0, 0.0));
            assert_eq!(far.v, further.v);
        }
        for j in 0..4000 {
            let (s, h) = (-0.75 + 5e-4 * f64::from(j), 1e-7);
            let (m, c, p) = (table.at(s - h), table.at(s), table.at(s + h));
            assert!((c.d - (p.v - m.v) / (2.0 * h)).abs() < 1e-5 * (1.0 + c.d.abs()), "{s}");
            assert!((c.dd - (p.d - m.d) / (2.0 * h)).abs() < 2e-4 * (1.0 + c.dd.abs()), "{s} {c:?} {m:?} {p:?}");
        }
    }
}

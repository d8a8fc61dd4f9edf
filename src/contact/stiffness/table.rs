//! A function of the position on the path as a cubic spline, twice continuously differentiable and read in O(1).
//!
//! Toward a clipped end of the path the Hertz part contains a logarithm, and toward a pointed tip the bending contains
//! one. In the outer quarters the knots therefore cluster quadratically at the ends: index = n √(distance). In the
//! middle half they are evenly spaced, and adjacent cells at the joints have equal widths. `past_end` continues past
//! the ends.

use super::past_end::PastEnd;
use super::spline::{Cell, cells, cubic};
use crate::numeric::{Jet, sqrt};

/// Number of cells in each outer quarter and in the middle half.
const CELLS: usize = 256;

/// Compliance along the path of contact.
#[derive(Clone, Debug)]
pub struct ComplianceTable {
    low: f64,
    high: f64,
    /// Length of an outer quarter [rad].
    quarter: f64,
    /// Number of cells of an outer quarter over the square root of its length.
    cells_per_sqrt: f64,
    /// Number of cells per length in the middle half [1/rad].
    per_length: f64,
    cells: Box<[Cell; 3 * CELLS]>,
    past_end: [PastEnd; 2],
}

impl ComplianceTable {
    /// Tabulates the function `f` on [`low`, `high`]. `past_end` returns the continuation past the lower (0) or the
    /// upper end (1) from the value and the outward derivatives at this end.
    pub fn new(low: f64, high: f64, f: impl Fn(f64) -> f64, past_end: impl Fn(usize, Jet) -> PastEnd) -> Self {
        let span = high - low;
        let knots: Vec<f64> = (0..=3 * CELLS).map(|j| low + span * share(j)).collect();
        let values: Vec<f64> = knots.iter().map(|&s| f(s)).collect();
        // slopes at the ends from fourth-order differences, because the function is known a little past them
        let step = END_STEP * span;
        let slope =
            |s: f64| (8.0 * (f(s + step) - f(s - step)) - (f(s + 2.0 * step) - f(s - 2.0 * step))) / (12.0 * step);
        let cells = cells(&knots, &values, [slope(low), slope(high)]);
        let first = cubic(&cells[0], low);
        let last = cubic(&cells[3 * CELLS - 1], high);
        let quarter = 0.25 * span;
        Self {
            low,
            high,
            quarter,
            cells_per_sqrt: CELLS as f64 / sqrt(quarter),
            per_length: CELLS as f64 / (2.0 * quarter),
            cells,
            past_end: [past_end(0, Jet { d: -first.d, ..first }), past_end(1, last)],
        }
    }

    /// Value with derivatives at any finite `s`.
    #[inline]
    pub fn at(&self, s: f64) -> Jet {
        let (above, below) = (s - self.low, self.high - s);
        let cell = if above < self.quarter {
            if above < 0.0 {
                let mirrored = self.past_end[0].at(-above);
                return Jet { d: -mirrored.d, ..mirrored };
            }
            (self.cells_per_sqrt * sqrt(above)) as usize
        } else if below < self.quarter {
            if below < 0.0 {
                return self.past_end[1].at(-below);
            }
            3 * CELLS - 1 - (self.cells_per_sqrt * sqrt(below)) as usize
        } else {
            CELLS + (self.per_length * (above - self.quarter)) as usize
        };
        // rounding may select the neighbouring cell, whose cubic has the same value at the common knot
        cubic(&self.cells[cell.min(3 * CELLS - 1)], s)
    }
}

/// Step of the differences for the end slopes, as a fraction of the table's length.
const END_STEP: f64 = 1e-4;

/// Position of knot `j` as a fraction of the table's length.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A logarithm whose pole is as near to the end as for a clipped path.
    fn function(s: f64) -> f64 {
        5.0 - libm::log(s + 0.504) + crate::numeric::sin(2.0 * s)
    }

    fn table() -> ComplianceTable {
        ComplianceTable::new(-0.5, 1.0, function, |_, end| PastEnd::levelling_off(end, 0.1))
    }

    #[test]
    fn a_logarithm_near_the_end_is_reproduced_within_a_millionth() {
        let table = table();
        let mut worst = 0f64;
        for j in 0..=10_000 {
            let s = -0.5 + 1.5e-4 * f64::from(j);
            worst = worst.max((table.at(s).v / function(s) - 1.0).abs());
        }
        assert!(worst < 1e-6, "{worst:e}");
    }

    #[test]
    fn value_slope_and_curvature_have_no_jumps() {
        let table = table();
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
        for j in 0..4000 {
            let (s, h) = (-0.75 + 5e-4 * f64::from(j), 1e-7);
            let (m, c, p) = (table.at(s - h), table.at(s), table.at(s + h));
            assert!((c.d - (p.v - m.v) / (2.0 * h)).abs() < 1e-5 * (1.0 + c.d.abs()), "{s}");
            assert!((c.dd - (p.d - m.d) / (2.0 * h)).abs() < 2e-4 * (1.0 + c.dd.abs()), "{s} {c:?} {m:?} {p:?}");
        }
    }
}

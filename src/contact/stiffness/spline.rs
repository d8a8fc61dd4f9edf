//! Cubic splines through values at knots of any spacing: twice continuously differentiable, with given slopes at the
//! ends.

use crate::numeric::Jet;

/// A cell: its first knot, and the coefficients of its cubic in the distance from this knot.
pub type Cell = [f64; 5];

/// Value and derivatives of the cubic of a cell at `s`.
#[inline]
pub fn cubic(c: &Cell, s: f64) -> Jet {
    let x = s - c[0];
    Jet {
        v: c[1] + x * (c[2] + x * (c[3] + x * c[4])),
        d: c[2] + x * (2.0 * c[3] + x * 3.0 * c[4]),
        dd: 2.0 * c[3] + x * 6.0 * c[4],
    }
}

/// Cells of the spline through `values` at `knots`, one fewer than knots, with the slopes `slope` at its ends.
pub fn cells<const N: usize>(knots: &[f64], values: &[f64], slope: [f64; 2]) -> Box<[Cell; N]> {
    let second = second_derivatives(knots, values, slope);
    let mut cells = Box::new([[0.0; 5]; N]);
    for (j, cell) in cells.iter_mut().enumerate() {
        let h = knots[j + 1] - knots[j];
        let (a, b) = (second[j], second[j + 1]);
        let rise = (values[j + 1] - values[j]) / h;
        *cell = [knots[j], values[j], rise - h * (2.0 * a + b) / 6.0, 0.5 * a, (b - a) / (6.0 * h)];
    }
    cells
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

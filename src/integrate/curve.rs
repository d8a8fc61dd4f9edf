//! Extremes and crossings of a quantity within a step of the integrator, from the dense output.

use super::system::Point;
use super::trajectory::{Extension, extended};
use crate::numeric::quadratic_roots;

/// Nodes and weights of the Gauss–Legendre quadrature with three points on [0, 1]. It is exact up to degree 5.
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
/// Margin for rounding in the bound on how far a curve moves.
const MARGIN: f64 = 1.001;

/// A component of the dense output of a step, or a linear combination of components; see [`extended`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// Value at the start of the step.
    pub start: f64,
    /// Value at the end of the step.
    pub end: f64,
    /// Coefficients b of the dense output; 0 for a straight line.
    pub coefficients: [f64; 3],
}

impl Curve {
    /// Curve of a quantity `of` the motion within a step. The quantity must be linear in the motion.
    pub fn of<const N: usize>(extension: &Extension<N>, of: impl Fn(&Point<N>) -> f64) -> Self {
        let Extension { start, end, coefficients } = extension;
        let nothing = of(&Point::ZERO);
        Self {
            start: of(start),
            end: of(end),
            coefficients: coefficients.each_ref().map(|coefficient| of(coefficient) - nothing),
        }
    }

    /// Straight line between the values at both ends of the step.
    pub fn line(start: f64, end: f64) -> Self {
        Self { start, end, coefficients: [0.0; 3] }
    }

    /// Parabola through the values at the start, in the middle and at the end of the step.
    pub fn parabola([start, middle, end]: [f64; 3]) -> Self {
        Self { start, end, coefficients: [4.0 * middle - 2.0 * (start + end), 0.0, 0.0] }
    }

    /// Curve over the first part of the step, up to the fraction `part`.
    pub fn up_to(&self, part: f64) -> Self {
        if part == 1.0 {
            return *self;
        }
        let [a, b, c] = self.coefficients;
        // coefficients of Θ², Θ³ and Θ⁴
        let (square, cube, fourth) = (b - a, c - b, -c);
        let c = -fourth * part * part * part * part;
        let b = c - cube * part * part * part;
        let a = b - square * part * part;
        Self { start: self.start, end: self.at(part), coefficients: [a, b, c] }
    }

    /// Mean over a span of fractions of the step.
    pub fn mean(&self, [from, to]: [f64; 2]) -> f64 {
        GAUSS.iter().map(|(node, weight)| weight * self.at(from + node * (to - from))).sum()
    }

    /// Value after a fraction of the step.
    pub fn at(&self, fraction: f64) -> f64 {
        if fraction == 1.0 { self.end } else { extended(self.start, self.end, self.coefficients, fraction) }
    }

    /// Coefficients of the derivative with respect to the fraction, a cubic.
    fn slope(&self) -> [f64; 4] {
        let Self { start, end, coefficients: [a, b, c] } = *self;
        [end - start + a, 2.0 * (b - a), 3.0 * (c - b), -4.0 * c]
    }

    /// Extends `extremes`, the smallest and the largest value so far, by the values over a span.
    pub fn extend(&self, extremes: &mut [f64; 2], [from, to]: [f64; 2]) {
        let with = |[least, largest]: [f64; 2], value: f64| [least.min(value), largest.max(value)];
        *extremes = with(with(*extremes, self.at(from)), self.at(to));
        let slope = self.slope();
        let slope_at = |t: f64| slope[0] + t * (slope[1] + t * (slope[2] + t * slope[3]));
        // the slope is monotonic between its own extremes
        let turns = quadratic_roots([slope[1], 2.0 * slope[2], 3.0 * slope[3]]).map(|t| t.clamp(from, to));
        let [first, second] = [turns[0].min(turns[1]), turns[0].max(turns[1])];
        for [low, high] in [[from, first], [first, second], [second, to]] {
            let slope = slope_at(low);
            if slope * slope_at(high) < 0.0 {
                // up to its extreme, the curve is nowhere steeper than at `low`; most extremes stay within `extremes`,
                // and need no search
                let farthest = self.at(low) + MARGIN * slope * (high - low);
                if farthest < extremes[0] || farthest > extremes[1] {
                    *extremes = with(*extremes, self.at(root(slope_at, [low, high])));
                }
            } else if high < to {
                *extremes = with(*extremes, self.at(high));
            }
        }
    }

    /// Fraction of the step, within `span`, at which the curve takes `value`. The value must be between the values at
    /// the ends of the span.
    pub fn crossing(&self, value: f64, span: [f64; 2]) -> f64 {
        root(|t| self.at(t) - value, span)
    }
}

/// Root of `of` in a span at whose ends `of` has different signs, by bisection to the last bit.
fn root(of: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let begin = of(low);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        let value = of(middle);
        if value == 0.0 {
            return middle;
        }
        if (value < 0.0) == (begin < 0.0) { low = middle } else { high = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CURVE: Curve = Curve { start: 0.3, end: 1.6, coefficients: [0.5, -2.0, 3.0] };

    #[test]
    fn a_mean_is_the_quotient_of_integral_and_span() {
        for [from, to] in [[0.0, 1.0], [0.25, 0.75], [0.9, 0.9001], [0.4, 0.4]] {
            let points = 100_000;
            let fraction = |k: i32| from + (to - from) * (f64::from(k) + 0.5) / f64::from(points);
            let mean = (0..points).map(|k| CURVE.at(fraction(k))).sum::<f64>() / f64::from(points);
            assert!((CURVE.mean([from, to]) - mean).abs() < 1e-9, "{from} {to}");
        }
    }

    #[test]
    fn the_first_part_of_a_curve_has_its_values() {
        for part in [1e-9, 0.3, 0.99, 1.0] {
            let cut = CURVE.up_to(part);
            for at in [0.0, 0.2, 0.5, 0.9, 1.0] {
                assert!((cut.at(at) - CURVE.at(part * at)).abs() < 1e-14, "{part} {at}");
            }
        }
    }

    #[test]
    fn a_parabola_has_the_values_that_define_it() {
        let [start, middle, end] = [0.0, 0.5, 1.0].map(|at| Curve::parabola([3.0, -1.0, 4.0]).at(at));
        assert_eq!([start, middle, end], [3.0, -1.0, 4.0]);
    }
}

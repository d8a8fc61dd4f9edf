//! Roots: of a rising function, from its values and slopes with Newton's method within a bracket; of a quadratic.

use super::{quotient, sqrt};

/// Maximum number of evaluations; a dozen is enough.
const MAX_EVALUATIONS: usize = 200;

/// Root x of `f`, which rises from below 0 at x = 0. `f` returns value and slope. The value at the root is within
/// ±`balance` and as close to 0 as rounding allows. Returns `None` if `f` is below 0 up to x = `most`.
///
/// Newton's steps start at the far end, so for a function that curves up they never pass the root. A bisection replaces
/// a step that leaves the bracket or follows a step that did not halve the value.
pub fn rising_root(f: impl Fn(f64) -> [f64; 2], most: f64, balance: f64) -> Option<f64> {
    let (mut low, mut high, mut x) = (0.0, most, most);
    let [mut value, mut slope] = f(x);
    // written so that NaN also returns `None`
    let reached = value >= 0.0;
    if !reached {
        return None;
    }
    let mut halved = true;
    for _ in 0..MAX_EVALUATIONS {
        let newton = quotient(value, slope).map_or(high, |step| x - step);
        let next = if halved && low < newton && newton < high { newton } else { 0.5 * (low + high) };
        if value == 0.0 || next == low || next == high {
            break;
        }
        let [next_value, next_slope] = f(next);
        halved = next_value.abs() <= 0.5 * value.abs();
        if value.abs() <= balance && !halved {
            break;
        }
        if next_value < 0.0 {
            low = next
        } else {
            high = next
        }
        (x, value, slope) = (next, next_value, next_slope);
    }
    Some(x)
}

/// Real roots of a quadratic whose coefficients `c` start with the constant. A missing root is replaced by 0.
pub fn quadratic_roots(c: [f64; 3]) -> [f64; 2] {
    let discriminant = c[1] * c[1] - 4.0 * c[2] * c[0];
    if discriminant.is_nan() || discriminant <= 0.0 {
        return [0.0; 2];
    }
    let q = -0.5 * (c[1] + sqrt(discriminant).copysign(c[1]));
    [quotient(q, c[2]), quotient(c[0], q)].map(Option::unwrap_or_default)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_quadratics_are_found() {
        for [a, b] in [[1.0, 3.0], [-2.0, 0.5], [1e-3, 1e3], [-4.0, -0.25]] {
            let mut found = quadratic_roots([a * b, -(a + b), 1.0]);
            found.sort_by(f64::total_cmp);
            let expected = [f64::min(a, b), f64::max(a, b)];
            assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-14 * expected[i].abs()), "{a} {b}: {found:?}");
        }
        assert_eq!(quadratic_roots([1.0, 0.0, 1.0]), [0.0; 2]);
        // a line, and a constant
        assert_eq!(quadratic_roots([1.0, -2.0, 0.0]).map(f64::abs), [0.0, 0.5]);
        assert_eq!(quadratic_roots([1.0, 0.0, 0.0]), [0.0; 2]);
    }
}

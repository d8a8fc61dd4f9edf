//! Root of a rising function, from its values and slopes: Newton's method within a bracket.

use super::quotient;

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

//! Loaded part of a face: its ends in closed form, and the motion of the ends with the load.
//!
//! A slice at cone distance R penetrates by the arc p = A − e(R)/R, with the approach A and the opening
//! e = E + turn R + bend R² (`Opening`). With a = A − turn, R p = a R − E − bend R². Because bend ≥ 0, p is positive on
//! at most one interval.

use crate::numeric::sqrt;

/// Bend so small that the upper root is beyond every face [1/m]. It replaces 0, because a host may trap divisions by zero.
const LEAST_BEND: f64 = 1e-100;

/// Loaded part of a face.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// Ends [m].
    pub ends: [f64; 2],
    /// Motion of the ends with the approach, ∂R/∂A [m/rad]; 0 at an edge of the face.
    pub by_arc: [f64; 2],
}

/// Motion of the points of a loaded part with its ends, as functions of the pair's approach A and opening E.
///
/// At an end that moves with the load, p(R; A, E) = 0. The end therefore moves by dR = −(dA − dE/R)/p′.
#[derive(Clone, Copy, Debug)]
pub struct Moves {
    /// Lower end [m].
    from: f64,
    /// Reciprocal of the part's length [1/m].
    per_length: f64,
    /// ∂R/∂A and ∂R/∂E, of the lower and the upper end.
    ends: [[f64; 2]; 2],
    /// Derivatives of ln(length of the part) with respect to A and to E.
    stretch: [f64; 2],
}

impl Moves {
    /// Returns the motion of the points of `span`.
    pub fn new(span: &Span) -> Self {
        let [from, to] = span.ends;
        let per_length = 1.0 / (to - from);
        let [low, high] = [0, 1].map(|i| [span.by_arc[i], -span.by_arc[i] / span.ends[i]]);
        let stretch = [0, 1].map(|by| (high[by] - low[by]) * per_length);
        Self { from, per_length, ends: [low, high], stretch }
    }

    /// For A, then for E: [derivative of the position of the point at `cone`, derivative of ln(width that the point
    /// represents)].
    #[inline(always)]
    pub fn at(&self, cone: f64) -> [[f64; 2]; 2] {
        let along = (cone - self.from) * self.per_length;
        let [low, high] = self.ends;
        [0, 1].map(|by| [low[by] + along * (high[by] - low[by]), self.stretch[by]])
    }
}

/// True if the face is loaded at the cone distance `r` [m]. `a` is the approach minus the turn [rad], `opening_at_apex`
/// is E [m], and `bend` is in 1/m.
#[inline(always)]
pub fn is_loaded_at(a: f64, opening_at_apex: f64, bend: f64, r: f64) -> bool {
    a * r - opening_at_apex - bend * r * r > 0.0
}

/// Part of [from, to] on which a R − E − bend R² is positive. `None` if it is nowhere positive.
#[inline(always)]
pub fn loaded_span(a: f64, opening_at_apex: f64, bend: f64, [from, to]: [f64; 2]) -> Option<Span> {
    match (is_loaded_at(a, opening_at_apex, bend, from), is_loaded_at(a, opening_at_apex, bend, to)) {
        (true, true) => Some(Span { ends: [from, to], by_arc: [0.0; 2] }),
        (lower, upper) => part(a, opening_at_apex, bend, [from, to], [lower, upper]),
    }
}

/// Loaded part of [from, to] if at least one end is not loaded. `None` if no part is loaded.
#[inline(never)]
fn part(a: f64, opening_at_apex: f64, bend: f64, [from, to]: [f64; 2], ends_loaded: [bool; 2]) -> Option<Span> {
    let discriminant = a * a - 4.0 * bend * opening_at_apex;
    // if neither end is loaded, the face can be loaded only around the top of the parabola
    if ends_loaded == [false; 2] && !(discriminant > 0.0 && a > 2.0 * bend * from && a < 2.0 * bend * to) {
        return None;
    }
    // roots without cancellation; if there is only one root, the other is not used
    let root = sqrt(discriminant.max(0.0));
    let larger = 0.5 * (a.abs() + root);
    let [low, high] = if a > 0.0 {
        [opening_at_apex / larger, larger / bend.max(LEAST_BEND)]
    } else {
        [f64::NEG_INFINITY, -opening_at_apex / larger]
    };
    let end = |at_edge: bool, edge: f64, sign: f64, r: f64| {
        if at_edge || !(r > from && r < to) {
            return [if at_edge { edge } else { r.clamp(from, to) }, 0.0];
        }
        // R p has the slope ±√discriminant at its roots
        [r, if root > 0.0 { sign * r / root } else { 0.0 }]
    };
    let [low, high] = [end(ends_loaded[0], from, -1.0, low), end(ends_loaded[1], to, 1.0, high)];
    (low[0] < high[0]).then_some(Span { ends: [low[0], high[0]], by_arc: [low[1], high[1]] })
}

//! The part of a face that carries: its ends in closed form, and how they move with the load.
//!
//! R p = a R − E − bend R² with a the approach less the turn and bend ≥ 0: positive on one interval.

use crate::numeric::sqrt;

/// What carries of a face.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// Its ends [m].
    pub ends: [f64; 2],
    /// By how much they move with the approach, ∂R/∂A [m/rad]; 0 at an edge.
    pub by_arc: [f64; 2],
}

/// How the points of a part move with its ends, by the approach A and the opening E of the pair.
///
/// At an end that the load moves p(R; A, E) = 0, so that it moves by dR = −(dA − dE/R)/p′.
#[derive(Clone, Copy, Debug)]
pub struct Moves {
    from: f64,
    per_length: f64,
    /// ∂R/∂A and ∂R/∂E of both ends.
    ends: [[f64; 2]; 2],
    /// By how much the part stretches, by its length.
    integration: [f64; 2],
}

impl Moves {
    /// Of the points of `span`.
    pub fn new(span: &Span) -> Self {
        let [from, to] = span.ends;
        let per_length = 1.0 / (to - from);
        let [low, high] = [0, 1].map(|i| [span.by_arc[i], -span.by_arc[i] / span.ends[i]]);
        let integration = [0, 1].map(|by| (high[by] - low[by]) * per_length);
        Self { from, per_length, ends: [low, high], integration }
    }

    /// By A and by E: how far the point at `cone` moves, and by how much the width that it stands for grows.
    #[inline(always)]
    pub fn at(&self, cone: f64) -> [[f64; 2]; 2] {
        let along = (cone - self.from) * self.per_length;
        let [low, high] = self.ends;
        [0, 1].map(|by| [low[by] + along * (high[by] - low[by]), self.integration[by]])
    }
}

/// Whether the face carries at the cone distance `r`.
#[inline(always)]
pub fn carries(a: f64, even: f64, bend: f64, r: f64) -> bool {
    a * r - even - bend * r * r > 0.0
}

/// The part of [from, to] on which a R − E − bend R² is positive, bend ≥ 0.
#[inline(always)]
pub fn carrying(a: f64, even: f64, bend: f64, [from, to]: [f64; 2]) -> Option<Span> {
    match (carries(a, even, bend, from), carries(a, even, bend, to)) {
        (true, true) => Some(Span { ends: [from, to], by_arc: [0.0; 2] }),
        (lower, upper) => part(a, even, bend, [from, to], [lower, upper]),
    }
}

/// The same where not all of it carries.
#[inline(never)]
fn part(a: f64, even: f64, bend: f64, [from, to]: [f64; 2], carries: [bool; 2]) -> Option<Span> {
    let square = a * a - 4.0 * bend * even;
    // between the ends it carries where the parabola's top is
    if carries == [false; 2] && !(square > 0.0 && a > 2.0 * bend * from && a < 2.0 * bend * to) {
        return None;
    }
    // roots without cancellation; where there is but one, the other is not asked for
    let root = sqrt(square.max(0.0));
    let larger = 0.5 * (a.abs() + root);
    let [low, high] = if a > 0.0 { [even / larger, larger / bend] } else { [f64::NEG_INFINITY, -even / larger] };
    let end = |at_edge: bool, edge: f64, way: f64, r: f64| {
        if at_edge || !(r > from && r < to) {
            return [if at_edge { edge } else { r.clamp(from, to) }, 0.0];
        }
        // R p has the slope ±√square at its roots
        [r, if root > 0.0 { way * r / root } else { 0.0 }]
    };
    let [low, high] = [end(carries[0], from, -1.0, low), end(carries[1], to, 1.0, high)];
    (low[0] < high[0]).then_some(Span { ends: [low[0], high[0]], by_arc: [low[1], high[1]] })
}

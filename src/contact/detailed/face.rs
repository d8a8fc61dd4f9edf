//! The face of a tooth pair under load: its loaded part, and the points over which loads are summed.
//!
//! A slice at cone distance R penetrates by the arc p = A − e(R, s)/R with the opening e = E + turn R + bend R² of the
//! flanks ([`Opening`]). R p is a polynomial of second degree and bend is not negative, so the loaded part of the face
//! is one interval on each side of a broken tooth's edge. Its ends follow in closed form.
//!
//! Under a linear law, the energy is a polynomial of fourth degree in R, and four Gauss points on that interval are
//! exact. The load therefore grows and falls smoothly, and force and energy are consistent to the last digit.
//!
//! Any other law uses eight points if the load is far from zero, and otherwise twelve points clustered at the ends
//! (`points`). The ends of a loaded part move with the load, and its points move with them. The derivative of a sum
//! includes this motion (`loaded_span`).

use super::loaded_span::{Moves, Span, is_loaded_at, loaded_span};
use super::points::{CROWDED, EIGHT, GAUSS, GAUSS_EIGHT, MAX_NODES, POINTS, nodes};
use super::{Node, Opening, Slice};

/// Distance past the ends of a face, relative to its length, at which the load must not yet be zero if eight points are
/// used.
const CLEAR: f64 = 0.25;

/// The face of a tooth pair.
#[derive(Clone, Copy, Debug)]
pub enum Face {
    /// A law with one resultant for the face.
    Whole(Node),
    /// A linear law that is valid at every cone distance between two ends [m], with the points of a fully loaded face.
    Linear([f64; 2], [Node; POINTS]),
    /// Any law that is valid at every cone distance between two ends [m], with the points of a face loaded well past
    /// both ends.
    General([f64; 2], [Node; EIGHT]),
}

impl Face {
    /// Returns a face between cone distances `inner` and `outer` [m] under a linear law.
    pub fn linear(inner: f64, outer: f64) -> Self {
        Self::Linear([inner, outer], nodes(&GAUSS, [inner, outer]))
    }

    /// Returns a face between cone distances `inner` and `outer` [m] under any law.
    pub fn general(inner: f64, outer: f64) -> Self {
        Self::General([inner, outer], Self::gauss_points([inner, outer]))
    }

    /// Eight Gauss points over a whole face between two cone distances [m].
    pub fn gauss_points(ends: [f64; 2]) -> [Node; EIGHT] {
        nodes(&GAUSS_EIGHT, ends)
    }

    /// Returns a face whose law has its resultant at one slice.
    pub fn whole(slice: Slice) -> Self {
        Self::Whole(slice.into())
    }

    /// True if loads differ over the face.
    pub fn is_distributed(&self) -> bool {
        self.ends().is_some()
    }

    /// Ends of the face [m], or `None` if loads do not differ over it.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Self::Whole(_) => None,
            Self::Linear(ends, _) | Self::General(ends, _) => Some(*ends),
        }
    }

    /// Points of the fully loaded face.
    pub fn nodes(&self) -> &[Node] {
        match self {
            Self::Whole(node) => std::slice::from_ref(node),
            Self::Linear(_, nodes) => nodes,
            Self::General(_, nodes) => nodes,
        }
    }

    /// Maximum number of points of a sum over the face.
    pub fn points(&self) -> usize {
        match self {
            Self::Whole(_) => 1,
            Self::Linear(..) => POINTS,
            Self::General(..) => MAX_NODES,
        }
    }

    /// Smallest cone distance that can be loaded [m].
    pub fn inner(&self) -> f64 {
        match self {
            Self::Whole(node) => node.cone,
            Self::Linear([inner, _], _) | Self::General([inner, _], _) => *inner,
        }
    }

    /// Sum of all weights, and cone distance of the resultant of error-free teeth [m].
    pub fn moment(&self) -> (f64, f64) {
        match self {
            Self::Whole(node) => (node.weight, node.cone),
            Self::Linear([inner, outer], _) | Self::General([inner, outer], _) => {
                let moment = (outer * outer * outer - inner * inner * inner) / 3.0;
                (moment, moment / (0.5 * (outer * outer - inner * inner)))
            }
        }
    }

    /// Width over which the force of the whole face is spread [m].
    pub fn width(&self) -> f64 {
        match self {
            Self::Whole(node) => node.width,
            // a load ωR is the line load ω R_F at the resultant
            Self::Linear([inner, outer], _) | Self::General([inner, outer], _) => {
                0.5 * (outer * outer - inner * inner) / self.moment().1
            }
        }
    }

    /// True if a part of the face is loaded at the approach `arc` [rad].
    #[inline(always)]
    pub fn is_loaded(&self, arc: f64, opening: &Opening) -> bool {
        let (a, even) = (arc - opening.turn, opening.even.v);
        let has_load = |even: f64, ends: [f64; 2]| loaded_span(a, even, opening.bend, ends).is_some();
        match (self, opening.edge) {
            (Self::Whole(node), Some((edge, depth))) if node.cone > edge => {
                is_loaded_at(a, even + depth, opening.bend, node.cone)
            }
            (Self::Whole(node), _) => is_loaded_at(a, even, opening.bend, node.cone),
            (Self::Linear(ends, _) | Self::General(ends, _), None) => has_load(even, *ends),
            (Self::Linear([inner, outer], _) | Self::General([inner, outer], _), Some((edge, depth))) => {
                let edge = edge.clamp(*inner, *outer);
                *inner < edge && has_load(even, [*inner, edge])
                    || edge < *outer && has_load(even + depth, [edge, *outer])
            }
        }
    }

    /// The loaded parts at the approach `arc` [rad]: sound and broken. `storage` is for the points of partly loaded
    /// faces.
    #[inline(always)]
    pub fn loaded<'a>(&'a self, arc: f64, opening: &Opening, storage: &'a mut PointStorage) -> [Part<'a>; 2] {
        let a = arc - opening.turn;
        let [even, bend] = [opening.even.v, opening.bend];
        match self {
            Self::Whole(node) => {
                let even = match opening.edge {
                    Some((edge, depth)) if node.cone > edge => even + depth,
                    _ => even,
                };
                let all: &[Node] =
                    if is_loaded_at(a, even, bend, node.cone) { std::slice::from_ref(node) } else { &[] };
                [Part { nodes: all, even, moves: None }, Part::NONE]
            }
            Self::Linear(ends, all) => parts(*ends, opening, a, &mut storage.exact, |even, span, room| match span {
                Some(span) if span.ends == *ends => Part { nodes: all, even, moves: None },
                // the sums are exact for any position of their points
                Some(span) => Part { nodes: room.insert(nodes(&GAUSS, span.ends)), even, moves: None },
                None => Part::NONE,
            }),
            Self::General(ends, all) => parts(*ends, opening, a, &mut storage.crowded, |even, span, room| {
                let Some(span) = span else { return Part::NONE };
                let past = CLEAR * (ends[1] - ends[0]);
                let is_clear = |r: f64| is_loaded_at(a, even, bend, r);
                if span.ends == *ends && is_clear(ends[0] - past) && is_clear(ends[1] + past) {
                    return Part { nodes: all, even, moves: None };
                }
                let moves = (span.by_arc != [0.0; 2]).then(|| Moves::new(&span));
                Part { nodes: room.insert(nodes(&CROWDED, span.ends)), even, moves }
            }),
        }
    }
}

/// The sound and the broken part of a face between `ends` at the approach minus the turn `a`. `part` builds each from
/// E, its loaded span, and its storage.
#[inline(always)]
fn parts<'a, R>(
    ends: [f64; 2],
    opening: &Opening,
    a: f64,
    [first, second]: &'a mut [R; 2],
    part: impl Fn(f64, Option<Span>, &'a mut R) -> Part<'a>,
) -> [Part<'a>; 2] {
    let [even, bend] = [opening.even.v, opening.bend];
    let Some((edge, depth)) = opening.edge else {
        return [part(even, loaded_span(a, even, bend, ends), first), Part::NONE];
    };
    let ([inner, outer], edge) = (ends, edge.clamp(ends[0], ends[1]));
    let sound = if inner < edge { loaded_span(a, even, bend, [inner, edge]) } else { None };
    let beyond = even + depth;
    let broken = if edge < outer { loaded_span(a, beyond, bend, [edge, outer]) } else { None };
    [part(even, sound, first), part(beyond, broken, second)]
}

/// Storage for the points of partly loaded faces.
#[derive(Clone, Copy, Debug, Default)]
pub struct PointStorage {
    exact: [Option<[Node; POINTS]>; 2],
    crowded: [Option<[Node; MAX_NODES]>; 2],
}

/// A loaded part of the face.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Points of the part.
    pub nodes: &'a [Node],
    /// Value of E on the part [m].
    pub even: f64,
    /// Motion of the points, if sums over them are not exact.
    pub moves: Option<Moves>,
}

impl<'a> Part<'a> {
    /// An empty part.
    pub const NONE: Self = Self { nodes: &[], even: 0.0, moves: None };

    /// Returns a part that consists of one point.
    #[inline(always)]
    pub fn of(node: &'a Node) -> Self {
        Self { nodes: std::slice::from_ref(node), even: 0.0, moves: None }
    }

    /// True if the part is not loaded.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::{Jet, Scalar};

    const FACE: [f64; 2] = [22.4e-3, 42.4e-3];

    fn opening(even: f64, turn: f64, bend: f64, edge: Option<(f64, f64)>) -> Opening {
        Opening { even: Jet::constant(even), turn, bend, edge }
    }

    /// ∫R² max(p, 0)^n dR by the midpoint rule with many points.
    fn fine(a: f64, o: &Opening, n: i32) -> f64 {
        let count = 200_000;
        let width = (FACE[1] - FACE[0]) / f64::from(count);
        (0..count)
            .map(|i| {
                let r = FACE[0] + width * (f64::from(i) + 0.5);
                let p = a - o.at(r) / r;
                if p > 0.0 { width * r * r * p.powi(n) } else { 0.0 }
            })
            .sum()
    }

    #[test]
    fn torque_and_energy_of_linear_teeth_match_a_fine_sum_for_any_loaded_part() {
        let face = Face::linear(FACE[0], FACE[1]);
        let mut parts = [0; 3];
        for a in [-4e-4, 2e-4, 6e-4, 1e-3] {
            for even in [-3e-5, 0.0, 1e-5, 2.5e-5] {
                for turn in [-2e-4, 0.0, 3e-4] {
                    for bend in [0.0, 5e-3, 0.1] {
                        for edge in [None, Some((30e-3, 5e-6)), Some((35e-3, 1e-3))] {
                            let o = opening(even, turn, bend, edge);
                            for n in [1, 2] {
                                let (mut sum, mut visits) = (0.0, 0);
                                for part in face.loaded(a, &o, &mut PointStorage::default()) {
                                    visits += usize::from(!part.is_empty());
                                    for j in part.nodes {
                                        let p = a - turn - part.even * j.per_cone - bend * j.cone;
                                        assert!(p > -1e-15);
                                        sum += j.weight * p.powi(n);
                                    }
                                }
                                parts[visits] += 1;
                                let fine = fine(a, &o, n);
                                let scale = fine + 1e-8 * face.moment().0 * 1e-3f64.powi(n);
                                assert!((sum - fine).abs() < 2e-5 * scale, "{a} {o:?} {n}: {sum:e} {fine:e}");
                            }
                        }
                    }
                }
            }
        }
        assert!(parts.iter().all(|&n| n > 20), "{parts:?}");
    }

    #[test]
    fn the_whole_face_has_the_closed_form_of_its_moments() {
        let face = Face::linear(FACE[0], FACE[1]);
        let (moment, cone) = face.moment();
        let mut storage = PointStorage::default();
        let [whole, _] = face.loaded(1e-3, &opening(0.0, 0.0, 0.0, None), &mut storage);
        let sum: f64 = whole.nodes.iter().map(|j| j.weight).sum();
        let force: f64 = whole.nodes.iter().map(|j| j.weight / j.cone).sum();
        assert!((sum / moment - 1.0).abs() < 1e-14 && (sum / force / cone - 1.0).abs() < 1e-14);
    }
}

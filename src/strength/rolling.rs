//! Rolling of a planet in a mesh, seen from its teeth: passages over the rated point, and the tooth in mesh.
//!
//! Positions are in pitches, and tooth n is in the middle of the mesh at position n. Positions within an interval are a
//! parabola through three values. All rules are the same for both directions of rolling.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use super::interval::{Three, at, extremum, reaching};
use crate::numeric::Finite;

/// Smallest distance from the rated point after which a return counts as another passage, in pitches. It is about the
/// width of the contact at full load: a contact that only rocks about the point does not unload it.
const WIDTH: f64 = 0.02;
/// Distance back from a change of teeth that brings the previous tooth into mesh again, in pitches. Two teeth share the
/// load at a change, so elastic wind-up rocks the gears without a change of teeth.
const SLACK: f64 = 0.25;
/// Maximum number of teeth that are counted individually in one interval and direction. Beyond it, each tooth stands
/// for several.
const MOST_TEETH: f64 = 4096.0;

/// A tooth that rolls past a point within an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passing {
    /// Number of the tooth.
    pub tooth: i64,
    /// Fraction of the interval.
    pub part: f64,
    /// Number of teeth for which this one stands: 1, unless very many pass.
    pub weight: f64,
}

/// Spans of an interval in which the parabola through `positions` is monotonic, in order.
fn monotonic_spans(positions: Three) -> impl Iterator<Item = [f64; 2]> {
    let turn = extremum(positions).map(|(_, part)| part);
    [Some([0.0, turn.unwrap_or(1.0)]), turn.map(|turn| [turn, 1.0])].into_iter().flatten()
}

/// Calls `visit` with each whole number that the parabola through `positions` reaches in a monotonic span, in the order
/// of the motion. A number at the start of the span does not count.
fn reached(positions: Three, span: [f64; 2], mut visit: impl FnMut(Passing)) {
    let [begin, end] = span.map(|part| at(positions, part));
    if !(begin.is_finite() && end.is_finite()) {
        return;
    }
    let way = if end < begin { -1.0 } else { 1.0 };
    let first = (way * begin).floor() + 1.0;
    let count = (way * end).floor() - first + 1.0;
    let weight = (count / MOST_TEETH).ceil().max(1.0);
    for i in 0..(count / weight).ceil().max(0.0) as i64 {
        let part = reaching(positions, way * (first + i as f64 * weight), span);
        visit(Passing { tooth: ((way * first) as i64).wrapping_add(way as i64 * i), part, weight });
    }
}

/// Passages of the contact of one flank over the rated point of its teeth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RatedPoint {
    /// Tooth that passed last.
    last: i64,
    /// True while the contact is still within the contact's width of the rated point of this tooth.
    is_near: bool,
}

impl Finite for RatedPoint {
    /// True for any numbers of teeth.
    fn is_finite(&self) -> bool {
        true
    }
}

impl RatedPoint {
    /// Calls `visit` with each passage within an interval. `positions` are those of the contact relative to the rated
    /// point of tooth 0 of an arbitrary count, which `shift` converts to numbers of teeth.
    pub fn pass(&mut self, positions: Three, shift: i64, mut visit: impl FnMut(Passing)) {
        self.leave(positions[0], shift);
        for span in monotonic_spans(positions) {
            reached(positions, span, |passing| {
                let tooth = passing.tooth.wrapping_add(shift);
                if !(self.is_near && self.last == tooth) {
                    *self = Self { last: tooth, is_near: true };
                    visit(Passing { tooth, ..passing });
                }
            });
            self.leave(at(positions, span[1]), shift);
        }
    }

    /// Notes if the contact at `position` has left the rated point.
    fn leave(&mut self, position: f64, shift: i64) {
        self.is_near &= (position - self.last.wrapping_sub(shift) as f64).abs() < WIDTH;
    }
}

/// The tooth in mesh if one spring represents the whole mesh. It has the load of the mesh over one pitch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ToothInMesh {
    /// Number of the tooth; `None` before the first interval.
    pub tooth: Option<i64>,
    /// Position at which this tooth entered the mesh, relative to its middle; 0 for the first tooth.
    entry: f64,
}

impl Finite for ToothInMesh {
    fn is_finite(&self) -> bool {
        self.entry.is_finite()
    }
}

impl ToothInMesh {
    /// Returns the tooth in mesh at `position`, counted with `shift`. A tooth that cannot be in mesh is replaced.
    pub fn at(&mut self, position: f64, shift: i64) -> i64 {
        let middle = |tooth: i64| tooth.wrapping_sub(shift) as f64;
        match self.tooth {
            Some(tooth) if (position - middle(tooth)).abs() <= 0.5 + SLACK => tooth,
            _ => {
                let tooth = (libm::rint(position) as i64).wrapping_add(shift);
                *self = Self { tooth: Some(tooth), entry: 0.0 };
                tooth
            }
        }
    }

    /// Calls `change` with each tooth that enters the mesh in the span `[from, until]` of an interval. `positions` and
    /// `shift` are those of [`RatedPoint::pass`], relative to the middle of the mesh. [`Self::at`] has returned the first
    /// tooth.
    pub fn roll(&mut self, positions: Three, shift: i64, [from, until]: [f64; 2], mut change: impl FnMut(Passing)) {
        let mut tooth = self.at(at(positions, from), shift);
        let spans = monotonic_spans(positions).map(|[begin, end]| [begin.max(from), end.min(until)]);
        for span in spans.filter(|[begin, end]| begin < end) {
            let [begin, end] = span.map(|part| at(positions, part));
            let way = if end < begin { -1.0 } else { 1.0 };
            let middle = tooth.wrapping_sub(shift) as f64;
            let weight = ((end - middle).abs() / MOST_TEETH).ceil().max(1.0);
            let mut passed = 0.0;
            loop {
                let edge = (way * self.entry + SLACK).max(0.5);
                let passage = middle + way * (passed + edge);
                // NaN ends the loop
                if (way * passage).partial_cmp(&(way * end)) != Some(Ordering::Less) {
                    break;
                }
                tooth = tooth.wrapping_add(way as i64);
                *self = Self { tooth: Some(tooth), entry: way * (edge - 1.0) };
                change(Passing { tooth, part: reaching(positions, passage, span), weight });
                passed += weight;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Teeth that pass the rated point while the position goes through `path`, with straight lines between them.
    fn passed(path: &[f64]) -> Vec<i64> {
        let (mut point, mut teeth) = (RatedPoint::default(), Vec::new());
        for pair in path.windows(2) {
            point.pass([pair[0], 0.5 * (pair[0] + pair[1]), pair[1]], 0, |passing| teeth.push(passing.tooth));
        }
        teeth
    }

    /// Teeth that enter the mesh while the position goes through `path`.
    fn entered(path: &[f64]) -> Vec<i64> {
        let (mut mesh, mut teeth) = (ToothInMesh::default(), Vec::new());
        for pair in path.windows(2) {
            mesh.roll([pair[0], 0.5 * (pair[0] + pair[1]), pair[1]], 0, [0.0, 1.0], |passing| {
                teeth.push(passing.tooth)
            });
        }
        teeth
    }

    #[test]
    fn each_tooth_passes_once_in_each_direction() {
        for way in [1.0, -1.0] {
            let path = |count: usize| (0..=count).map(|i| way * (0.3 + 3.0 * i as f64 / count as f64)).collect();
            for count in [1, 2, 7, 100] {
                let mut there: Vec<f64> = path(count);
                assert_eq!(passed(&there), [1, 2, 3].map(|tooth| way as i64 * tooth), "{count}");
                let back: Vec<f64> = there.iter().rev().copied().collect();
                there.extend(back);
                assert_eq!(passed(&there), [1, 2, 3, 3, 2, 1].map(|tooth| way as i64 * tooth), "{count}");
            }
        }
    }

    #[test]
    fn a_contact_that_rocks_about_the_rated_point_passes_once() {
        for way in [1.0, -1.0] {
            let rocking =
                |reach: f64| (0..20).map(|i| way * if i % 2 == 0 { -reach } else { reach }).collect::<Vec<_>>();
            assert_eq!(passed(&rocking(0.9 * WIDTH)).len(), 1);
            assert_eq!(passed(&rocking(1.1 * WIDTH)).len(), 19);
        }
        // a turn within one interval counts there and back
        let mut count = 0;
        RatedPoint::default().pass([-0.1, 0.1, -0.1], 0, |_| count += 1);
        assert_eq!(count, 2);
    }

    #[test]
    fn a_tooth_is_in_mesh_for_a_pitch_and_returns_after_a_quarter_of_a_pitch() {
        for way in [1.0, -1.0] {
            let signed = |path: &[f64]| path.iter().map(|x| way * x).collect::<Vec<_>>();
            let teeth = |teeth: &[i64]| teeth.iter().map(|tooth| way as i64 * tooth).collect::<Vec<_>>();
            assert_eq!(entered(&signed(&[0.0, 0.49])), []);
            assert_eq!(entered(&signed(&[0.0, 3.2])), teeth(&[1, 2, 3]));
            assert_eq!(entered(&signed(&[0.0, 0.51, 0.26, 0.51, 0.3])), teeth(&[1]));
            // the tooth that returns stays until it has left at the usual position
            assert_eq!(entered(&signed(&[0.0, 0.51, 0.24, 0.49, 0.51])), teeth(&[1, 0, 1]));
        }
    }

    #[test]
    fn very_many_teeth_are_counted_together_and_hostile_positions_end() {
        for end in [1e5, -1e9, 1e18, -1e300] {
            let (mut weights, mut visits) = (0.0, 0);
            RatedPoint::default().pass([0.1, 0.5 * end, end], 0, |passing| {
                weights += passing.weight;
                visits += 1;
            });
            assert!(visits <= 4097 && (weights / end.abs() - 1.0).abs() < 1e-3, "{end}: {visits} {weights}");
            let mut entries = 0;
            ToothInMesh::default().roll([0.1, 0.5 * end, end], 0, [0.0, 1.0], |_| entries += 1);
            assert!(entries <= 4097, "{end}: {entries}");
        }
        for bad in [f64::NAN, f64::INFINITY] {
            RatedPoint::default().pass([0.0, bad, 2.0], 0, |passing| assert!(passing.part >= 0.0));
            ToothInMesh::default().roll([0.0, 1.0, bad], 0, [0.0, 1.0], |passing| assert!(passing.part >= 0.0));
        }
    }
}

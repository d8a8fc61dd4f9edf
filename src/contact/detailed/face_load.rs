//! Face load factor: how unevenly a pair's load is distributed over its face.
//!
//! The load per width of aligned teeth is w = ωR, with the same ω at every R. If errors or displacements open the
//! flanks by e(R), ω follows the law of a slice at the arc A − e(R)/R. The face load factor is the largest ω of the
//! face over its mean. The mean has the weight R², like the torque:
//!
//! K_Hβ = ω_max ∫R² dR / ∫ω R² dR
//!
//! The smallest value of e/R = E/R + turn + bend R is at an end of the face, at the edge of a broken tooth, or at R² =
//! E/bend.

use super::face::PointStorage;
use super::sums::Approach;
use super::{Detailed, Opening, SliceLoad};
use crate::contact::AnySpring;
use crate::contact::Spring;
use crate::numeric::sqrt;

/// A loaded slice of the pair.
#[derive(Clone, Copy, Debug)]
pub struct KnownSlice {
    /// Cone distance [m].
    pub cone: f64,
    /// Penetration arc [rad].
    pub arc: f64,
    /// Position on the path [rad].
    pub s: f64,
}

impl Detailed {
    /// Moment ∫R² dR of the face [m³]: ratio of a pair's torque to ω.
    pub fn moment_of_face(&self) -> f64 {
        self.moment
    }

    /// Load per width [N/m] of the pair of `slice` at the cone distance `cone` [m], which need not be the slice's own.
    pub fn line_load(&self, slice: &SliceLoad, cone: f64) -> f64 {
        let arc = slice.approach.arc - slice.opening.at(cone) / cone;
        self.line_load_at(&self.spring.local(slice.s), &slice.approach, arc, cone)
    }

    /// Load per width [N/m] at the cone distance `cone` [m], if the flanks penetrate by `arc` [rad]. `local` are the
    /// values of the law at the position on the path.
    pub fn line_load_at(&self, local: &<AnySpring as Spring>::Local, approach: &Approach, arc: f64, cone: f64) -> f64 {
        if arc <= 0.0 {
            return 0.0;
        }
        let rate = approach.rate - approach.opening_rate / cone;
        let elastic = self.spring.respond(local, arc);
        cone * self.damping.apply(elastic.torque, elastic.stiffness, arc, rate).total
    }

    /// Returns K_Hβ of the pair with the loaded slice `known`. It uses the elastic load; the damping force is
    /// distributed in the same way. K_Hβ is 1 if a law has one resultant for the whole face.
    pub fn face_load_factor(&self, known: &KnownSlice, opening: &Opening) -> f64 {
        let Some(ends) = self.face.ends() else { return 1.0 };
        let approach = known.arc + opening.at(known.cone) / known.cone;
        let local = self.spring.local(known.s);
        let load = |arc: f64| if arc > 0.0 { self.spring.respond(&local, arc).torque } else { 0.0 };
        let mut torque = 0.0;
        for part in self.face.loaded(approach, opening, &mut PointStorage::default()) {
            for node in part.nodes {
                let arc = approach - opening.turn - part.even * node.per_cone - opening.bend * node.cone;
                torque += node.weight * load(arc);
            }
        }
        let factor = load(approach - least_arc(opening, ends)) * self.moment / torque;
        // written so that NaN gives 1
        if factor > 1.0 && factor.is_finite() { factor } else { 1.0 }
    }
}

/// Smallest arc e(R)/R [rad] between the cone distances `inner` and `outer` [m].
fn least_arc(opening: &Opening, [inner, outer]: [f64; 2]) -> f64 {
    let (edge, depth) = opening.edge.unwrap_or((outer, 0.0));
    let edge = edge.clamp(inner, outer);
    let least = |even: f64, [from, to]: [f64; 2]| {
        let at = |r: f64| even / r + opening.turn + opening.bend * r;
        // square of the position where the slope is 0; dividing by infinity gives 0 if it is far outside
        let divisor = if even.abs() < 2.0 * to * to * opening.bend.abs() { opening.bend } else { f64::INFINITY };
        let inside = sqrt((even / divisor).max(0.0));
        let ends = at(from).min(at(to));
        if inside > from && inside < to { ends.min(at(inside)) } else { ends }
    };
    let sound = if edge > inner { least(opening.even.v, [inner, edge]) } else { f64::INFINITY };
    let broken = if edge < outer { least(opening.even.v + depth, [edge, outer]) } else { f64::INFINITY };
    sound.min(broken)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::{Jet, Scalar};

    const FACE: [f64; 2] = [22.4e-3, 42.4e-3];

    #[test]
    fn the_least_arc_matches_a_fine_search() {
        for even in [-3e-5, 0.0, 2e-5, 6e-5] {
            for turn in [-2e-3, 0.0, 1e-3] {
                for bend in [0.0, 0.01, 0.06, 0.6] {
                    for edge in [None, Some((30e-3, 4e-6)), Some((20e-3, 1e-3)), Some((50e-3, 1e-3))] {
                        let opening = Opening { even: Jet::constant(even), turn, bend, edge };
                        let search = (0..=20_000)
                            .map(|i| FACE[0] + (FACE[1] - FACE[0]) * f64::from(i) / 20_000.0)
                            .map(|r| opening.at(r) / r)
                            .fold(f64::INFINITY, f64::min);
                        let found = least_arc(&opening, FACE);
                        assert!((found - search).abs() < 1e-7, "{opening:?}: {found} {search}");
                    }
                }
            }
        }
    }
}

//! Position of the gears between their teeth, which determines the tooth of each gear that is in mesh.
//!
//! A tooth has the load of its mesh over one pitch, from half a pitch before its middle to half a pitch behind it. If
//! two teeth share the load, elastic wind-up rocks the gears without a change of teeth. The previous tooth therefore
//! returns only when the gears have turned back by [`SLACK`].

use serde::{Deserialize, Serialize};

use crate::numeric::finite;

/// Distance back from a change of teeth that brings the previous tooth into mesh again, as a fraction of the pitch.
const SLACK: f64 = 0.25;

/// Position within the pitch of the tooth in mesh, in pitches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeshPlace {
    /// Number of the tooth in mesh, 0 at the start. Teeth that enter the mesh as angles grow are positive.
    pub tooth: i64,
    /// Position from the middle of this tooth.
    place: f64,
    /// Position at which this tooth entered the mesh; 0 for the first tooth.
    entry: f64,
}

/// Change of the tooth in mesh in an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Fraction of the interval after which the first tooth leaves the mesh, from 0 to 1.
    pub leaves: f64,
    /// Fraction of the interval after which the last tooth enters the mesh. It is larger than `leaves` if other teeth
    /// pass between.
    pub enters: f64,
    /// True if the gears roll on in one direction, so that the passage of the last tooth counts as a cycle. After a
    /// reversal, the gears roll one pitch before passages count.
    pub rolls_on: bool,
}

finite!(MeshPlace { place, entry; tooth });

impl MeshPlace {
    /// Advances by `step` pitches of either sign.
    pub fn advance(&mut self, step: f64) -> Option<Change> {
        let wanted = self.place + step;
        if !wanted.is_finite() {
            return None;
        }
        let sense = if step < 0.0 { -1.0 } else { 1.0 };
        let (before, way, entry) = (sense * self.place, sense * wanted, sense * self.entry);
        let edge = (entry + SLACK).max(0.5);
        if way <= edge {
            self.place = wanted;
            return None;
        }
        let further = (way - 1.5).ceil().max(0.0);
        let part = |place: f64| ((place - before) / step.abs()).clamp(0.0, 1.0);
        let last = if further > 0.0 { further + 0.5 } else { edge };
        let change = Change { leaves: part(edge), enters: part(last), rolls_on: entry <= 0.0 || further > 0.0 };
        self.tooth = self.tooth.wrapping_add((sense * (1.0 + further)) as i64);
        self.entry = sense * (last - 1.0 - further);
        // rounding can make very large positions deviate by whole pitches; these are reset to the middle of the tooth
        let place = way - 1.0 - further;
        self.place = if place.abs() <= 1.0 { sense * place } else { 0.0 };
        Some(change)
    }

    /// Returns the number of the tooth in mesh, shifted by `offset` teeth, for a gear with `teeth` teeth. It also
    /// returns `teeth`, at least 1.
    pub fn tooth_of(&self, teeth: usize, offset: usize) -> (usize, usize) {
        let teeth = teeth.max(1);
        ((self.tooth.rem_euclid(teeth as i64) as usize + offset) % teeth, teeth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_tooth_is_in_mesh_for_a_pitch_either_way() {
        for sign in [1.0, -1.0] {
            let mut place = MeshPlace::default();
            for i in 1..1000 {
                // binary fractions, so that the positions are exact
                let change = place.advance(sign / 128.0);
                let tooth = (f64::from(i) / 128.0 - 0.5).ceil() as i64;
                assert_eq!(place.tooth, sign as i64 * tooth, "{i}");
                assert!(change.is_none_or(|change| change.rolls_on && change.leaves == change.enters));
            }
        }
    }

    #[test]
    fn rocking_about_a_change_brings_no_tooth_back() {
        for sign in [1.0, -1.0] {
            let mut place = MeshPlace::default();
            place.advance(sign * 0.51);
            for _ in 0..10 {
                assert_eq!(place.advance(sign * -0.2), None);
                assert_eq!(place.advance(sign * 0.2), None);
            }
            assert_eq!(place.tooth, sign as i64);
            // back from a quarter of a pitch, and forward again at the position at which it first entered
            let back = place.advance(sign * -0.3).unwrap();
            assert!(!back.rolls_on && place.tooth == 0);
            assert_eq!(place.advance(sign * 0.28), None);
            assert!(!place.advance(sign * 0.02).unwrap().rolls_on && place.tooth == sign as i64);
        }
    }

    #[test]
    fn many_teeth_pass_in_one_step() {
        let mut place = MeshPlace::default();
        let change = place.advance(4.0).unwrap();
        // the first leaves at ½, the fourth enters at 3½
        assert_eq!((change.leaves, change.enters, place.tooth, place.place), (0.125, 0.875, 4, 0.0));
        assert_eq!([(10, 0), (10, 5), (3, 0)].map(|(teeth, offset)| place.tooth_of(teeth, offset).0), [4, 9, 1]);
        for step in [1e18, -1e300, f64::NAN, f64::INFINITY, f64::MAX] {
            place.advance(step);
            assert!(place.place.abs() <= 1.0 && place.entry.abs() <= 1.0, "{step} {place:?}");
        }
    }
}

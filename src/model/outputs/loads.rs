//! Loads of a planet's tooth pairs at an instant: for single pairs or slices, for any cone distance of the face, and
//! for whole pairs with the distribution of each load over its face.

use crate::contact::ToothLoad;
use crate::contact::detailed::SliceLoad;
use crate::contact::pair_load::PairLoad;
use crate::contact::planet::Visit;
use crate::geometry::Pair;
use crate::integrate::Point;
use crate::model::dynamics::{Largest, MAX_SIZE};

impl Largest<'_> {
    /// Visits every loaded tooth pair of the mesh of group `g` with side `s`.
    pub fn tooth_loads(
        &self,
        pair: &Pair,
        at: &Point<MAX_SIZE>,
        g: usize,
        s: usize,
        mut visit: impl FnMut(&ToothLoad),
    ) {
        self.visit_loads(at, g, &Visit { sides: s..s + 1, directions: Some(pair) }, &mut |load, _| visit(load));
    }

    /// Visits every loaded tooth pair without directions. If loads differ over the face, `visit` also receives a
    /// function that returns the load per width [N/m] at any cone distance [m].
    pub fn loads_over_the_face(
        &self,
        at: &Point<MAX_SIZE>,
        g: usize,
        s: usize,
        mut visit: impl FnMut(&ToothLoad, Option<&dyn Fn(f64) -> f64>),
    ) {
        let detailed = &self.teeth.contact.detailed;
        let is_sliced = self.is_sliced();
        self.visit_loads(at, g, &Visit { sides: s..s + 1, directions: None }, &mut |load, slice| match slice {
            Some(slice) if is_sliced => visit(load, Some(&|cone| detailed.line_load(slice, cone))),
            _ => visit(load, None),
        });
    }

    /// Visits every loaded slice if loads are summed over the face. The slices of a pair follow one another.
    pub fn slices(&self, at: &Point<MAX_SIZE>, g: usize, s: usize, mut visit: impl FnMut(&SliceLoad)) {
        self.visit_loads(at, g, &Visit { sides: s..s + 1, directions: None }, &mut |_, slice| {
            if let Some(slice) = slice {
                visit(slice);
            }
        });
    }

    /// Visits every loaded tooth pair of group `g` as a whole, with its side.
    pub fn pair_loads(&self, pair: &Pair, at: &Point<MAX_SIZE>, g: usize, mut visit: impl FnMut(usize, &PairLoad)) {
        // the slices of a pair follow one another
        let mut open: Option<(usize, [usize; 2], PairLoad)> = None;
        let mut close = |side: usize, load: &mut PairLoad| {
            if self.is_sliced() {
                // pressure at the position of the largest load, which may be between slices or at an end
                let mean = load.moment / self.teeth.contact.detailed.moment_of_face();
                load.steepest = load.steepest.max(load.face_factor * mean);
            }
            visit(side, load);
        };
        let both = Visit { sides: 0..2, directions: None };
        self.visit_loads(at, g, &both, &mut |slice, _| match &mut open {
            Some((side, teeth, load)) if (*side, *teeth, load.flank) == (slice.side, slice.teeth, slice.flank) => {
                load.add(slice);
            }
            _ => {
                let face_factor = self.face_load_factor(pair, at, g, slice);
                let next = PairLoad::new(slice, self.teeth.contact.mesh.whole.cone, face_factor);
                if let Some((side, _, mut load)) = open.replace((slice.side, slice.teeth, next)) {
                    close(side, &mut load);
                }
            }
        });
        if let Some((side, _, mut load)) = open {
            close(side, &mut load);
        }
    }
}

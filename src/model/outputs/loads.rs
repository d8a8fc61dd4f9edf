//! Loads of the tooth pairs of a planet at an instant, as they are read: of single pairs or slices, of the face at any cone distance, and
//! of whole pairs with how evenly each is spread over its face.

use crate::contact::ToothLoad;
use crate::contact::detailed::SliceLoad;
use crate::contact::pair_load::PairLoad;
use crate::contact::planet::Visit;
use crate::geometry::Pair;
use crate::integrate::Point;
use crate::model::dynamics::{LARGEST, Largest};

impl Largest<'_> {
    /// Visits every loaded tooth pair of the mesh of group `g` with side `s`.
    pub fn tooth_loads(&self, pair: &Pair, at: &Point<LARGEST>, g: usize, s: usize, mut visit: impl FnMut(&ToothLoad)) {
        self.visit_loads(at, g, &Visit { sides: s..s + 1, directions: Some(pair) }, &mut |load, _| visit(load));
    }

    /// Visits every loaded tooth pair without directions, with its load per width [N/m] at any cone distance [m] where this differs
    /// over the face.
    pub fn loads_over_the_face(
        &self,
        at: &Point<LARGEST>,
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

    /// Visits every loaded slice of the face where loads are summed over it, each pair's one after the other.
    pub fn slices(&self, at: &Point<LARGEST>, g: usize, s: usize, mut visit: impl FnMut(&SliceLoad)) {
        self.visit_loads(at, g, &Visit { sides: s..s + 1, directions: None }, &mut |_, slice| {
            if let Some(slice) = slice {
                visit(slice);
            }
        });
    }

    /// Visits every loaded tooth pair of group `g` as a whole, with its side.
    pub fn pair_loads(&self, pair: &Pair, at: &Point<LARGEST>, g: usize, mut visit: impl FnMut(usize, &PairLoad)) {
        // slices of a pair come one after the other
        let mut open: Option<(usize, [usize; 2], PairLoad)> = None;
        let mut close = |side: usize, load: &mut PairLoad| {
            if self.is_sliced() {
                // the pressure where the load is the largest, be it between slices or at an end
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

//! Loads of whole tooth pairs at an instant, with how evenly each is spread over its face.

use super::Equations;
use crate::FULL;
use crate::contact::detailed::{KnownSlice, Opening};
use crate::contact::errors::{MeshId, PairId};
use crate::contact::pair_load::PairLoad;
use crate::contact::{Law, ToothLoad};
use crate::geometry::Pair;
use crate::integrate::Point;
use crate::numeric::{cos, sin};

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    /// Visits every loaded tooth pair of the mesh of group `g` with side `s`.
    pub fn pair_loads(&self, pair: &Pair, at: &Point<N>, g: usize, s: usize, mut visit: impl FnMut(&PairLoad)) {
        // slices of a pair come one after the other
        let mut open: Option<([usize; 2], PairLoad)> = None;
        let mut close = |load: &mut PairLoad| {
            let detailed = &self.teeth.effect_terms.detailed;
            if self.is_sliced() {
                // the pressure where the load is the largest, be it between slices or at an end
                let mean = load.moment / detailed.moment_of_face();
                load.steepest = load.steepest.max(load.face_factor * mean);
            }
            visit(load);
        };
        self.visit_loads(at, g, s, &|_| [0.0; 3], &mut |slice, _| match &mut open {
            Some((teeth, load)) if *teeth == slice.teeth && load.flank == slice.flank => load.add(slice),
            _ => {
                let next = PairLoad::new(slice, self.teeth.mesh.cone, self.face_load_factor(pair, at, g, slice));
                if let Some((_, mut load)) = open.replace((slice.teeth, next)) {
                    close(&mut load);
                }
            }
        });
        if let Some((_, mut load)) = open {
            close(&mut load);
        }
    }

    /// Whether meshes are summed slice by slice over the face.
    pub(super) fn is_sliced(&self) -> bool {
        let effect_terms = &self.teeth.effect_terms;
        WITH_EFFECTS && self.in_detail() && effect_terms.detailed.face.is_cut()
    }

    /// K_Hβ of the pair of which `slice` is a loaded slice; 1 where a law has one resultant for the whole face.
    fn face_load_factor(&self, pair: &Pair, at: &Point<N>, g: usize, slice: &ToothLoad) -> f64 {
        let effect_terms = &self.teeth.effect_terms;
        if let (true, false, Law::Solid(solid)) = (FULL, self.in_detail(), &self.teeth.mesh.law) {
            return solid.face_load_factor(&self.mesh_state(at, g, slice.side), slice.flank, slice.s);
        }
        if !self.is_sliced() {
            return 1.0;
        }
        let mesh = MeshId { planet: slice.planet, side: slice.side };
        let [planet_tooth, side_tooth] = slice.teeth;
        let teeth = PairId { planet_tooth, side_tooth, flank: slice.flank };
        let mut opening = self.gaps().map_or(Opening::NONE, |gaps| gaps.of(mesh, teeth, slice.s));
        if self.has_pins() {
            let axial = cos(pair.gears[1].base) * sin(pair.pitch_arc[1] - slice.s);
            opening.even.v += at.q[self.seat(slice.side)] * axial;
        }
        let known = KnownSlice { cone: slice.cone, arc: slice.depth / slice.cone, s: slice.s };
        effect_terms.detailed.face_load_factor(&known, &opening)
    }
}

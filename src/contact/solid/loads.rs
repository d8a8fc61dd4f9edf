//! Loads of single sections of solid teeth, and the face load factor of a pair.

use nalgebra::Vector3;

use super::mesh::{PlacedSlice, SolidMesh, SolidSlice};
use crate::contact::Flank;
use crate::contact::impact::Force;
use crate::contact::state::MeshState;

/// A loaded section of one pair.
#[derive(Clone, Copy, Debug)]
pub struct SolidLoad {
    /// Flank of the planet.
    pub flank: Flank,
    /// Number of the pair, counted like tooth pairs on the path of contact.
    pub number: i64,
    /// Position from the planet's rotation [rad].
    pub s: f64,
    /// The section.
    pub slice: SolidSlice,
    /// Overlap of the section as an arc [rad].
    pub depth: f64,
    /// Force.
    pub force: Force,
    /// Point on the flank: components of the unit vector along the planet's axis, along the side gear's axis, and
    /// across.
    pub point: [f64; 3],
    /// Polar angles of the point on planet and side gear, each about the gear's own displaced axis [rad].
    pub polar: [f64; 2],
    /// Normal into the side gear, in the same components as `point`.
    pub normal: [f64; 3],
}

impl SolidLoad {
    /// Components of the normal that load the bearings: along the planet's axis and the side gear's axis, both away
    /// from the apex, and along the rotation.
    pub fn components(&self) -> [f64; 3] {
        // the planet is pushed back, the side gear forward
        let [planet, side, across] = self.normal;
        [-planet, side, across]
    }
}

impl SolidMesh {
    /// Face load factor K_Hβ of the pair of `flank` at position `s`: the largest load per width, in a section or at an
    /// edge, over the mean load. The mean has the weight R, like the torque. The load of a section depends only on its
    /// overlap, and aligned solids are loaded evenly.
    pub fn face_load_factor(&self, state: &MeshState, flank: Flank, s: f64) -> f64 {
        if self.slices.len() == 1 {
            return 1.0;
        }
        let (mut largest, mut mean) = (0.0f64, 0.0);
        for slices in [&self.slices, &self.edges] {
            self.sections::<0>(slices, state.which, state.position, |near, PlacedSlice { slice, .. }, p| {
                if p.v > 0.0 && near.flank == flank && near.s == s {
                    let load = self.elastic.force(self.cone * p.v, 0.0).elastic;
                    largest = largest.max(load);
                    mean += slice.share * load;
                }
            });
        }
        let factor = largest / mean;
        // written so that NaN gives 1
        if factor > 1.0 && factor.is_finite() { factor } else { 1.0 }
    }

    /// Calls `visit` with every loaded section.
    pub fn loaded(&self, state: &MeshState, mut visit: impl FnMut(&SolidLoad)) {
        let [dq, dx] = state.rate;
        self.sections::<1>(&self.slices, state.which, state.position, |near, placed, p| {
            if p.v <= 0.0 {
                return;
            }
            let slice = &placed.slice;
            let whole = self.respond(p.v, p.d[0] * dq + p.d[1] * dx);
            let share = slice.share * self.cone / slice.cone;
            let force = Force { total: share * whole.total, elastic: share * whole.elastic, ..whole };
            if let Some((placement, patch)) = self.patch(near, placed) {
                let point = Vector3::new(patch.position[0], patch.position[1], 1.0).normalize();
                let sign = if near.flank == Flank::Drive { 1.0 } else { -1.0 };
                let components = |w: [f64; 3]| {
                    let [planet, side, across] = placement.components(w);
                    [planet, side, sign * across]
                };
                visit(&SolidLoad {
                    flank: near.flank,
                    number: near.number,
                    s: near.s,
                    slice: *slice,
                    depth: p.v,
                    force,
                    point: components(point.into()),
                    polar: placement.polars(point, slice.cone),
                    normal: components(patch.normal),
                });
            }
        });
    }
}

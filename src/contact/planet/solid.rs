//! Solid teeth: the meshes are independent, and the force of a tooth pair follows from the overlap of its solids.

use super::load::LinearisedForce;
use super::{Contact, PlanetContact, PlanetState, Visit, Visitor};
use crate::contact::mesh::MeshForce;
use crate::contact::solid::mesh::SolidMesh;
use crate::contact::{ToothLoad, Touch};
use crate::geometry::Pair;

/// A planet with solid teeth.
#[derive(Clone, Copy)]
pub struct Solid<'a> {
    /// Constants.
    pub contact: &'a Contact,
    /// The solids.
    pub solid: &'a SolidMesh,
}

impl PlanetContact for Solid<'_> {
    type Load = MeshForce;
    type Linearised = LinearisedForce;

    #[inline(never)]
    fn write(&self, at: &PlanetState, to: &mut [MeshForce; 2]) {
        for s in 0..2 {
            to[s] = self.solid.force(&at.mesh(s));
        }
    }

    #[inline(never)]
    fn linearise(&self, at: &PlanetState, to: &mut [LinearisedForce; 2]) {
        for s in 0..2 {
            let (force, by) = self.solid.linearise(&at.mesh(s));
            to[s] = LinearisedForce { force, by };
        }
    }

    fn energies(&self, at: &PlanetState) -> [f64; 2] {
        [0, 1].map(|s| self.solid.energy([at.planet, s], at.mesh(s).position))
    }

    /// Returns `None`: the force of solid teeth is smooth enough between facets.
    fn kink(&self, _: &PlanetState, _: f64) -> Option<f64> {
        None
    }

    fn visit(&self, at: &PlanetState, visit: &Visit, see: &mut Visitor) {
        let mesh = &self.contact.mesh;
        for s in visit.sides.clone() {
            self.solid.loaded(&at.mesh(s), |load| {
                let (spot, spot_arc) = mesh.engagement.rigid_spot(load.s);
                let tooth = ToothLoad {
                    planet: at.planet,
                    side: s,
                    flank: load.flank,
                    spot,
                    spot_arc,
                    teeth: self.contact.perfect.teeth(at.name(s, load.flank, load.number)),
                    s: load.s,
                    cone: load.slice.cone,
                    share: load.slice.share,
                    line_load: load.force.total / load.slice.width,
                    depth: load.depth * load.slice.cone,
                    normal: load.force.total,
                    friction: 0.0,
                    components: load.components(),
                    touch: Some(Touch { point: load.point, polar: load.polar }),
                };
                see(&tooth, None);
            });
        }
    }

    fn face_load_factor(&self, at: &PlanetState, slice: &ToothLoad, _: &Pair) -> f64 {
        self.solid.face_load_factor(&at.mesh(slice.side), slice.flank, slice.s)
    }
}

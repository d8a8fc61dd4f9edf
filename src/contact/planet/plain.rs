//! Flanks that fit, on rigid gear bodies: the meshes are independent, and each tooth pair has one resultant.
//!
//! A pair's force F acts along the flank's normal n, tangent to the sphere. About a gear's axis it has the lever arm R
//! ℓ. Its component along the axis is therefore F √(sin²φ − ℓ²) at the polar angle φ. On the path ℓ = sinδ_b, and the
//! component is F cosδ_b sinψ. At s = 0 it equals the textbook's F sinα sinδ. The remaining component is tangential to
//! the carrier's rotation.

use super::load::LinearisedForce;
use super::{Contact, PlanetContact, PlanetState, Visit, Visitor, first};
use crate::contact::impact::Force;
use crate::contact::mesh::MeshForce;
use crate::contact::{Flank, Mesh, Spot, ToothLoad, ToothPair};
use crate::geometry::Pair;
use crate::numeric::{cos, sin, sqrt};

/// A planet whose flanks fit.
#[derive(Clone, Copy)]
pub struct Plain<'a> {
    /// Constants.
    pub contact: &'a Contact,
    /// True if forces are inlined into the steps. Otherwise, all callers share one function.
    pub is_part_of_steps: bool,
}

impl PlanetContact for Plain<'_> {
    type Load = MeshForce;
    type Linearised = LinearisedForce;

    #[inline(always)]
    fn write(&self, at: &PlanetState, to: &mut [MeshForce; 2]) {
        let (mesh, states) = (&self.contact.mesh, [at.mesh(0), at.mesh(1)]);
        for (state, to) in states.iter().zip(to) {
            if self.is_part_of_steps {
                mesh.write_force(state, to);
            } else {
                mesh.write_force_not_inlined(state, to);
            }
        }
    }

    #[inline(always)]
    fn linearise(&self, at: &PlanetState, to: &mut [LinearisedForce; 2]) {
        let mesh = &self.contact.mesh;
        for s in 0..2 {
            let (force, by) = if self.is_part_of_steps {
                mesh.linearise(&at.mesh(s))
            } else {
                mesh.linearise_not_inlined(&at.mesh(s))
            };
            to[s] = LinearisedForce { force, by };
        }
    }

    fn energies(&self, at: &PlanetState) -> [f64; 2] {
        [0, 1].map(|s| self.contact.mesh.energy(&at.mesh(s)))
    }

    #[inline(always)]
    fn kink(&self, at: &PlanetState, h: f64) -> Option<f64> {
        let mesh = &self.contact.mesh;
        first(mesh.kink(&at.mesh(0), h), mesh.kink(&at.mesh(1), h))
    }

    fn visit(&self, at: &PlanetState, visit: &Visit, see: &mut Visitor) {
        for s in visit.sides.clone() {
            self.contact
                .mesh
                .loaded(&at.mesh(s), |pair, force| see(&load(self.contact, (at, s), (pair, force), visit), None));
        }
    }
}

/// Load of `pair` on side `s` under its `force`.
fn load(
    contact: &Contact,
    (at, s): (&PlanetState, usize),
    (pair, force): (&ToothPair, &Force),
    visit: &Visit,
) -> ToothLoad {
    let mesh = &contact.mesh;
    ToothLoad {
        planet: at.planet,
        side: s,
        flank: pair.flank,
        spot: pair.spot,
        spot_arc: pair.spot_arc,
        teeth: contact.perfect.teeth(at.name(s, pair.flank, pair.number)),
        s: pair.s,
        cone: mesh.whole.cone,
        share: 1.0,
        line_load: force.total / contact.detailed.face.width(),
        depth: pair.depth * mesh.whole.cone,
        normal: force.total,
        friction: 0.0,
        components: visit.directions.map_or([0.0; 3], |of| components(of, mesh, pair)),
        touch: None,
    }
}

/// Components of the unit normal of a pair: along the planet's axis, along the side gear's axis, along the rotation.
pub fn components(pair: &Pair, mesh: &Mesh, contact: &ToothPair) -> [f64; 3] {
    let [lever_p, lever_s] = pair.sin_base();
    let along = |polar: f64, lever: f64| sqrt((sin(polar) * sin(polar) - lever * lever).max(0.0));
    let corner = &mesh.engagement.corner;
    let (planet, side) = match contact.spot {
        Spot::Path => (
            cos(pair.gears[0].base) * sin(pair.pitch_arc[0] + contact.spot_arc),
            cos(pair.gears[1].base) * sin(pair.pitch_arc[1] - contact.spot_arc),
        ),
        Spot::PlanetTip => {
            let corner = corner[0].exact(contact.spot_arc);
            (along(corner.own_polar, lever_p * (1.0 - corner.gap.d)), along(corner.mate_polar, lever_s))
        }
        Spot::SideTip => {
            let corner = corner[1].exact(contact.spot_arc);
            (along(corner.mate_polar, lever_p), along(corner.own_polar, lever_s * (1.0 - corner.gap.d)))
        }
    };
    let forward = sqrt((1.0 - planet * planet - side * side).max(0.0));
    [planet, side, if contact.flank == Flank::Drive { forward } else { -forward }]
}

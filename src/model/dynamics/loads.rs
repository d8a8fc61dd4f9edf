//! Loads of the tooth pairs of a mesh at an instant.
//!
//! A pair's force F acts along the flank's normal n, tangent to the sphere. About a gear's axis it has the lever arm
//! R ℓ, so that its part along the axis is F √(sin²φ − ℓ²) at polar angle φ; on the path ℓ = sinδ_b and that is
//! F cosδ_b sinψ, which at s = 0 is the textbook's F sinα sinδ. What remains is tangential to the carrier's rotation.

use super::Equations;
use crate::FULL;
use crate::contact::detailed::SliceLoad;
use crate::contact::{Flank, Law, Mesh, Spot, ToothLoad, ToothPair, Touch};
use crate::geometry::Pair;
use crate::integrate::Point;
use crate::numeric::{cos, sin, sqrt};

/// Parts of a unit normal force of one pair: along the planet's axis, along the side gear's axis, along the rotation.
pub fn parts(pair: &Pair, mesh: &Mesh, contact: &ToothPair) -> [f64; 3] {
    let [lever_p, lever_s] = pair.sin_base();
    let along = |polar: f64, lever: f64| sqrt((sin(polar) * sin(polar) - lever * lever).max(0.0));
    let corner = &mesh.engagement.corner;
    let (planet, side) = match contact.spot {
        Spot::Path => (
            cos(pair.gears[0].base) * sin(pair.pitch_arc[0] + contact.place),
            cos(pair.gears[1].base) * sin(pair.pitch_arc[1] - contact.place),
        ),
        Spot::PlanetTip => {
            let corner = corner[0].exact(contact.place);
            (along(corner.own_polar, lever_p * (1.0 - corner.gap.d)), along(corner.mate_polar, lever_s))
        }
        Spot::SideTip => {
            let corner = corner[1].exact(contact.place);
            (along(corner.mate_polar, lever_p), along(corner.own_polar, lever_s * (1.0 - corner.gap.d)))
        }
    };
    let forward = sqrt((1.0 - planet * planet - side * side).max(0.0));
    [planet, side, if contact.flank == Flank::Drive { forward } else { -forward }]
}

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    /// Visits every loaded tooth pair of the mesh of group `g` with side `s`.
    pub fn tooth_loads(&self, pair: &Pair, at: &Point<N>, g: usize, s: usize, mut visit: impl FnMut(&ToothLoad)) {
        self.visit_loads(at, g, s, &|contact| parts(pair, &self.teeth.mesh, contact), &mut |load, _| visit(load));
    }

    /// The same without directions, with the load per width [N/m] of the pair at any cone distance [m] where it differs over
    /// the face.
    pub fn loads_over_the_face(
        &self,
        at: &Point<N>,
        g: usize,
        s: usize,
        mut visit: impl FnMut(&ToothLoad, Option<&dyn Fn(f64) -> f64>),
    ) {
        let detailed = &self.teeth.effect_terms.detailed;
        let is_sliced = self.is_sliced();
        self.visit_loads(at, g, s, &|_| [0.0; 3], &mut |load, slice| match slice {
            Some(slice) if is_sliced => visit(load, Some(&|cone| detailed.line_load(slice, cone))),
            _ => visit(load, None),
        });
    }

    /// The same with the parts of the normal on the path of contact as `parts` gives them, which not all who visit read, and
    /// with the slice of a mesh in detail. Compiled once, for whoever visits.
    #[inline(never)]
    pub(super) fn visit_loads(
        &self,
        at: &Point<N>,
        g: usize,
        s: usize,
        parts: &dyn Fn(&ToothPair) -> [f64; 3],
        visit: &mut dyn FnMut(&ToothLoad, Option<&SliceLoad>),
    ) {
        let mesh = &self.teeth.mesh;
        let planet = self.teeth.plan.group(g).planet;
        let teeth =
            |flank: Flank, number: i64| self.teeth.effect_terms.perfect.teeth(self.pair_name(g, s, flank, number));
        if WITH_EFFECTS && self.in_detail() {
            self.detail(at, g, s, |slice| {
                let load = ToothLoad {
                    planet,
                    side: s,
                    flank: slice.pair.flank,
                    spot: slice.spot,
                    place: slice.place,
                    teeth: teeth(slice.pair.flank, slice.pair.number),
                    s: slice.s,
                    cone: slice.cone,
                    share: slice.share,
                    line_load: slice.line_load,
                    depth: slice.arc * slice.cone,
                    normal: slice.normal,
                    friction: slice.friction,
                    parts: slice.parts,
                    touch: None,
                };
                visit(&load, Some(slice));
            });
            return;
        }
        if let (true, Law::Solid(solid)) = (FULL, &mesh.law) {
            solid.loaded(&self.mesh_state(at, g, s), |load| {
                let (spot, place) = mesh.engagement.rigid_spot(load.s);
                let tooth = ToothLoad {
                    planet,
                    side: s,
                    flank: load.flank,
                    spot,
                    place,
                    teeth: teeth(load.flank, load.number),
                    s: load.s,
                    cone: load.slice.cone,
                    share: load.slice.share,
                    line_load: load.force.total / load.slice.width,
                    depth: load.depth * load.slice.cone,
                    normal: load.force.total,
                    friction: 0.0,
                    parts: load.parts(),
                    touch: Some(Touch { point: load.point, polar: load.polar }),
                };
                visit(&tooth, None);
            });
            return;
        }
        self.loaded_pairs(at, g, s, |contact, force| {
            let load = ToothLoad {
                planet,
                side: s,
                flank: contact.flank,
                spot: contact.spot,
                place: contact.place,
                teeth: teeth(contact.flank, contact.number),
                s: contact.s,
                cone: mesh.cone,
                share: 1.0,
                line_load: force.total / self.teeth.effect_terms.detailed.face.width(),
                depth: contact.depth * mesh.cone,
                normal: force.total,
                friction: 0.0,
                parts: parts(contact),
                touch: None,
            };
            visit(&load, None);
        });
    }
}

//! Loads of single tooth pairs at an instant: what outputs, strength and load histories are made of.
//!
//! A pair's force F acts along the flank's normal n, tangent to the sphere. About a gear's axis it has the lever arm
//! R ℓ, so that its part along the axis is F √(sin²φ − ℓ²) at polar angle φ; on the path ℓ = sinδ_b and that is
//! F cosδ_b sinψ, which at s = 0 is the textbook's F sinα sinδ. What remains is tangential to the carrier's rotation.

use super::equations::Equations;
use crate::contact::mesh::{Law, Mesh};
use crate::contact::pairs::{Flank, Spot, ToothPair};
use crate::geometry::Pair;
use crate::geometry::action::{Contact, LineOfAction};
use crate::integrate::Point;
use crate::numeric::{cos, sin, sqrt};

/// Load of one tooth pair, or of one slice of it where loads differ over the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothLoad {
    /// Planet that stands for its group, from 0.
    pub planet: usize,
    /// Side, 0 left and 1 right.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Kind of contact.
    pub spot: Spot,
    /// Arc Δ past the end of the path [rad]; the place on the path if on it.
    pub place: f64,
    /// Numbers of the planet's and the side gear's tooth, from 0.
    pub teeth: [usize; 2],
    /// Place on the path of contact [rad].
    pub s: f64,
    /// Cone distance at which the force acts [m].
    pub cone: f64,
    /// Share of the face that it stands for.
    pub share: f64,
    /// Normal force per width [N/m].
    pub line_load: f64,
    /// Penetration along the line of action [m].
    pub depth: f64,
    /// Normal force [N].
    pub normal: f64,
    /// Friction along the flank, positive toward the planet's root on the planet [N].
    pub friction: f64,
    /// Parts of the normal: along the planet's axis and the side gear's, away from the apex, and along the rotation.
    pub parts: [f64; 3],
    /// Where solid teeth touch, which `spot` and `place` tell of aligned ones alone.
    pub touch: Option<Touch>,
}

/// Where solid teeth touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Direction from the side gear's apex in parts along the axes of planet and side gear, apex to heel, and along the
    /// rotation.
    pub point: [f64; 3],
    /// Polar angles on planet and side gear, each about its own axis as it stands [rad].
    pub polar: [f64; 2],
}

impl ToothLoad {
    /// Which of the mirror images of the line of action it is on: +1 where the contact moves up the path when the planet
    /// turns forward about its axis from apex to heel.
    pub fn turn(&self) -> f64 {
        if (self.side == 0) == (self.flank == Flank::Coast) { 1.0 } else { -1.0 }
    }

    /// Where it acts, in the frame of the mesh.
    pub fn contact(&self, action: &LineOfAction) -> Contact {
        action.contact(self.spot, self.place, self.turn())
    }

    /// Azimuth of the middle of its tooth of gear `i` (0 planet, 1 side gear) from that of tooth 0, about the gear's axis
    /// from apex to heel [rad].
    pub fn tooth_azimuth(&self, pair: &Pair, i: usize) -> f64 {
        // planet teeth count about the axis to the apex, side gear teeth about +x, which leads away from it on the left
        let sign = if i == 1 && self.side == 0 { 1.0 } else { -1.0 };
        sign * self.teeth[i] as f64 * pair.gears[i].tooth_pitch()
    }
}

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

impl<const N: usize, const G: usize, const P: usize, const FULL: bool> Equations<'_, N, G, P, FULL> {
    /// Shows every loaded tooth pair of the mesh of group `g` with side `s`.
    pub fn tooth_loads(&self, pair: &Pair, at: &Point<N>, g: usize, s: usize, mut visit: impl FnMut(&ToothLoad)) {
        let mesh = &self.teeth.mesh;
        let planet = self.teeth.plan.group(g).planet;
        let wrapped = self.wrapped(g, s);
        let teeth = |flank: Flank, number: i64| {
            let tooth = if flank == Flank::Drive { number - wrapped } else { -(number + wrapped) };
            self.teeth.full.sound.teeth(crate::contact::detailed::PairName { planet, side: s, flank, tooth })
        };
        if FULL && self.teeth.full.in_detail {
            self.detail::<f64>(at, g, s, |slice| {
                visit(&ToothLoad {
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
                });
            });
            return;
        }
        if let Law::Solid(solid) = &mesh.law {
            solid.loaded(&self.mesh_state(at, g, s), |load| {
                let (spot, place) = mesh.engagement.rigid_spot(load.s);
                visit(&ToothLoad {
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
                });
            });
            return;
        }
        mesh.loaded(&self.mesh_state(at, g, s), |contact, force| {
            visit(&ToothLoad {
                planet,
                side: s,
                flank: contact.flank,
                spot: contact.spot,
                place: contact.place,
                teeth: teeth(contact.flank, contact.number),
                s: contact.s,
                cone: mesh.cone,
                share: 1.0,
                line_load: force.total / self.teeth.full.detailed.whole_width(),
                depth: contact.depth * mesh.cone,
                normal: force.total,
                friction: 0.0,
                parts: parts(pair, mesh, contact),
                touch: None,
            });
        });
    }
}

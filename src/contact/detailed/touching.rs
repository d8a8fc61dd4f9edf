//! A touching tooth pair: adds the loads of its face to the loads of its mesh.

use super::directions::Arcs;
use super::face::Part;
use super::sums::{LoadedNode, PairFriction, Sums};
use super::{Detailed, Face, MeshTeeth, Opening, PairMotion, PairName, SliceLoad, Totals};
use crate::contact::{Spring, ToothPair};

/// A touching pair.
pub struct Touching<'a, P, const OPEN: bool, const SHARED: bool> {
    /// Identity of the teeth.
    pub name: &'a PairName,
    /// The pair. If elastic gear bodies move it, its depth is its own arc (`contact::shared`).
    pub pair: &'a ToothPair,
    /// Values of the elastic law at the position of the pair, if known already.
    pub local: Option<P>,
    /// Opening of the flanks.
    pub opening: &'a Opening,
    /// Arcs of the pair, if the axial seats need them.
    pub arcs: Arcs,
    /// Loaded parts of the face.
    pub parts: [Part<'a>; 2],
    /// Motion of the pair.
    pub motion: PairMotion<OPEN, SHARED>,
}

impl Detailed {
    /// Adds the loads of a touching pair.
    #[inline(always)]
    pub(super) fn add_touching<
        S: Spring,
        const ROWS: usize,
        const WIDE: usize,
        const OPEN: bool,
        const SHARED: bool,
    >(
        &self,
        (spring, teeth, needs_thrust): (&S, &MeshTeeth, bool),
        totals: &mut Totals<ROWS, WIDE>,
        touching: Touching<S::Local, OPEN, SHARED>,
        mut look: impl FnMut(&SliceLoad),
    ) {
        let Touching { name, pair, local, opening, mut arcs, parts, motion } = touching;
        if !(OPEN && self.has_seats) && (needs_thrust || self.friction.is_some()) {
            arcs = self.directions.arcs(pair.s);
        }
        let warmed;
        let friction = match (&self.friction, teeth.viscosity) {
            (Some(law), Some(viscosity)) => {
                warmed = law.with_viscosity(viscosity);
                Some(&warmed)
            }
            (law, _) => law.as_ref(),
        };
        let pair_friction = friction.map(|law| {
            let geometry = self.directions.sliding_geometry(&arcs);
            let whole = self.friction_face.as_ref().filter(|_| !OPEN || !self.face.is_distributed()).map(Face::nodes);
            PairFriction { law, speeds: motion.speeds(&geometry), geometry, whole }
        });
        let normal = needs_thrust.then(|| self.directions.normal(teeth.engagement, pair.spot, &arcs, pair.spot_arc));
        let mut see = |node: &LoadedNode| {
            let Some(normal) = &normal else { return };
            let force = node.torque * node.node.weight * node.node.per_cone;
            let [planet, side, forward] = normal.components;
            look(&SliceLoad {
                pair,
                spot: pair.spot,
                spot_arc: pair.spot_arc,
                cone: node.node.cone,
                share: node.node.weight / self.moment,
                line_load: force / node.node.width,
                arc: node.arc,
                s: pair.s,
                energy: node.elastic.energy * node.node.weight,
                name: *name,
                normal: force,
                friction: node.friction.map_or(0.0, |(h, _)| -h * force),
                sliding: node.friction.map(|(_, sliding)| sliding),
                components: [planet, side, -motion.sign * forward],
                approach: motion.approach,
                opening,
            });
        };
        let local = local.unwrap_or_else(|| spring.local(pair.s));
        let law = (spring, &local, &self.damping);
        let mut sums = Sums::default();
        for part in if OPEN { &parts[..] } else { &parts[..1] } {
            let (at, pair_friction) = (&motion.approach, pair_friction.as_ref());
            if const { ROWS > 0 } {
                sums.add::<S, true, OPEN>(part, law, at, opening, pair_friction, &mut see);
            } else {
                sums.add::<S, false, OPEN>(part, law, at, opening, pair_friction, &mut see);
            }
        }
        totals.add_teeth(&motion, &sums);
        if let Some(pair_friction) = &pair_friction {
            totals.add_friction(&motion, &sums, pair_friction);
        }
        if let Some(normal) = &normal {
            totals.add_thrust(&motion, &sums, normal, pair.spot);
        }
    }
}

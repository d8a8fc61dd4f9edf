//! A touching tooth pair: adds the loads of its face to the loads of its mesh.

use super::face::Part;
use super::opening::Opened;
use super::sums::{Approach, LoadedNode, PairFriction, Sums};
use super::{Detailed, Face, MeshTeeth, Opening, PairMotion, PairName, SliceLoad, Totals};
use crate::contact::shared::Share;
use crate::contact::{Spring, ToothPair};

/// A pair that may touch.
pub struct NearPair<'a, P> {
    /// Identity of the teeth.
    pub name: &'a PairName,
    /// The pair; its depth is the approach of its flanks.
    pub pair: &'a ToothPair,
    /// Opening of the flanks.
    pub opened: &'a Opened,
    /// Values of the elastic law at the position of the pair, if known already.
    pub local: Option<P>,
    /// Share of the load. On rigid bodies, only its own arc is set, which equals the approach.
    pub share: &'a Share<'a>,
}

/// A touching pair.
pub struct Touching<'a, P, const OPEN: bool> {
    /// The pair.
    pub near: &'a NearPair<'a, P>,
    /// Loaded parts of the face.
    pub parts: [Part<'a>; 2],
    /// Motion of the pair.
    pub motion: PairMotion<OPEN>,
}

/// Data that the loads of all points of a pair share.
struct Seen<'a> {
    name: &'a PairName,
    pair: &'a ToothPair,
    opening: &'a Opening,
    approach: Approach,
    /// Sign of the forward direction.
    sign: f64,
    /// Sum of the weights of all points.
    moment: f64,
}

impl<'a> Seen<'a> {
    /// Load of one point of the face. The normal of the flanks has these `components` along the axes of planet and side
    /// gear, and forward.
    #[inline(always)]
    fn slice_load(&self, loaded: &LoadedNode<'a>, [planet, side, forward]: [f64; 3]) -> SliceLoad<'a> {
        let (LoadedNode { node, torque, friction, .. }, pair) = (loaded, self.pair);
        let force = torque * node.weight * node.per_cone;
        SliceLoad {
            spot: pair.spot,
            spot_arc: pair.spot_arc,
            cone: node.cone,
            share: node.weight / self.moment,
            line_load: force / node.width,
            arc: loaded.arc,
            s: pair.s,
            energy: loaded.elastic.energy * node.weight,
            name: *self.name,
            normal: force,
            friction: friction.map_or(0.0, |(h, _)| -h * force),
            sliding: friction.map(|(_, sliding)| sliding),
            components: [planet, side, -self.sign * forward],
            approach: self.approach,
            opening: self.opening,
        }
    }
}

impl Detailed {
    /// Adds the loads of a touching pair.
    #[inline(always)]
    pub(super) fn add_touching<S: Spring, const ROWS: usize, const WIDE: usize, const OPEN: bool>(
        &self,
        (spring, teeth, needs_thrust): (&S, &MeshTeeth, bool),
        totals: &mut Totals<ROWS, WIDE>,
        touching: Touching<S::Local, OPEN>,
        mut look: impl FnMut(&SliceLoad),
    ) {
        let Touching { near: NearPair { name, pair, opened, local, .. }, parts, motion } = touching;
        let (opening, mut arcs) = (&opened.opening, opened.arcs);
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
            let seen = Seen { name, pair, opening, approach: motion.approach, sign: motion.sign, moment: self.moment };
            look(&seen.slice_load(node, normal.components));
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

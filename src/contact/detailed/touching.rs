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

impl<P, const OPEN: bool, const SHARED: bool> Touching<'_, P, OPEN, SHARED> {
    /// Load of one point of the face. The normal of the flanks has the `components` along the planet's axis, along the
    /// side gear's axis, and forward. `moment` is the sum of the weights of all points.
    #[inline(always)]
    fn slice_load<'a>(&'a self, loaded: &LoadedNode<'a>, components: [f64; 3], moment: f64) -> SliceLoad<'a> {
        let (LoadedNode { node, torque, friction, .. }, pair) = (loaded, self.pair);
        let (force, [planet, side, forward]) = (torque * node.weight * node.per_cone, components);
        SliceLoad {
            pair,
            spot: pair.spot,
            spot_arc: pair.spot_arc,
            cone: node.cone,
            share: node.weight / moment,
            line_load: force / node.width,
            arc: loaded.arc,
            s: pair.s,
            energy: loaded.elastic.energy * node.weight,
            name: *self.name,
            normal: force,
            friction: friction.map_or(0.0, |(h, _)| -h * force),
            sliding: friction.map(|(_, sliding)| sliding),
            components: [planet, side, -self.motion.sign * forward],
            approach: self.motion.approach,
            opening: self.opening,
        }
    }
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
        let (pair, motion, mut arcs) = (touching.pair, &touching.motion, touching.arcs);
        if !(OPEN && self.has_seats) && (needs_thrust || self.friction.is_some()) {
            arcs = self.directions.arcs(pair.s);
        }
        let friction = self.friction.as_ref().map(|law| teeth.viscosity.map_or(*law, |of| law.with_viscosity(of)));
        let pair_friction = friction.as_ref().map(|law| {
            let geometry = self.directions.sliding_geometry(&arcs);
            let whole = self.friction_face.as_ref().filter(|_| !OPEN || !self.face.is_distributed()).map(Face::nodes);
            PairFriction { law, speeds: motion.speeds(&geometry), geometry, whole }
        });
        let normal = needs_thrust.then(|| self.directions.normal(teeth.engagement, pair.spot, &arcs, pair.spot_arc));
        let mut see = |node: &LoadedNode| {
            if let Some(normal) = &normal {
                look(&touching.slice_load(node, normal.components, self.moment));
            }
        };
        let local = touching.local.unwrap_or_else(|| spring.local(pair.s));
        let law = (spring, &local, &self.damping);
        let mut sums = Sums::default();
        for part in if OPEN { &touching.parts[..] } else { &touching.parts[..1] } {
            let (at, pair_friction) = (&motion.approach, pair_friction.as_ref());
            if const { ROWS > 0 } {
                sums.add::<S, true, OPEN>(part, law, at, touching.opening, pair_friction, &mut see);
            } else {
                sums.add::<S, false, OPEN>(part, law, at, touching.opening, pair_friction, &mut see);
            }
        }
        totals.add_teeth(motion, &sums);
        if let Some(pair_friction) = &pair_friction {
            totals.add_friction(motion, &sums, pair_friction);
        }
        if let Some(normal) = &normal {
            totals.add_thrust(motion, &sums, normal, pair.spot);
        }
    }
}

//! The detailed mesh: its constants, and the sum of loads over its tooth pairs.

use super::super::spring::with_spring;
use super::directions::{Arcs, Directions};
use super::face::{Face, Part, PointStorage};
use super::totals::SUMS;
use super::touching::Touching;
use super::{DetailedLoad, DetailedState, LOCAL, Node, Opening, PairMotion, PairName, SliceLoad, Totals};
use crate::contact::{AnySpring, Damping, Engagement, Flank, FlankGaps, Spot, Spring, ToothFriction, ToothPair};
use crate::geometry::Pair;
use crate::numeric::Dual;

/// Constants of a detailed mesh.
#[derive(Clone, Debug)]
pub struct Detailed {
    /// Elastic law per unit of the face's weights.
    pub spring: AnySpring,
    /// Damping per unit of the face's weights, in arcs and torques ([`Damping::in_arcs`]).
    pub(super) damping: Damping,
    /// The face.
    pub face: Face,
    /// The face under a law that is valid at every cone distance. It is also set if `face` is one point because flanks
    /// fit: friction then still differs over the face.
    pub(super) friction_face: Option<Face>,
    /// True if the mesh has one spring instead of tooth pairs.
    pub is_single: bool,
    /// Friction along the flanks.
    pub friction: Option<ToothFriction>,
    /// True if any friction depends on thrust and bearing force of the gears.
    pub needs_thrust: bool,
    /// True if side gears move along their axes.
    pub has_seats: bool,
    pub(super) directions: Directions,
    /// Sum of the face's weights: ∫R² dR, or 1 if the law has one resultant for the face.
    pub(super) moment: f64,
    /// Cone distance of the resultant of teeth that fit [m].
    resultant: f64,
    /// The face of teeth that fit, as one point.
    whole: Node,
}

/// Teeth of a mesh in their present state: tooth pairs, errors, oil viscosity, planet and side gear.
#[derive(Clone, Copy)]
pub struct MeshTeeth<'a> {
    /// Tooth pairs.
    pub engagement: &'a Engagement,
    /// Errors of the teeth.
    pub gaps: Option<&'a FlankGaps>,
    /// Viscosity of the oil at its temperature [Pa·s], for a friction law that takes it from the oil. `None` keeps the
    /// law's own value.
    pub viscosity: Option<f64>,
    /// Planet.
    pub planet: usize,
    /// Side, 0 left and 1 right.
    pub side: usize,
}

impl MeshTeeth<'_> {
    /// Name of pair `number` of `flank`, of a planet whose position was wrapped by `wrapped` pairs.
    #[inline(always)]
    fn name(&self, flank: Flank, number: i64, wrapped: i64) -> PairName {
        PairName::new((self.planet, self.side), flank, number, wrapped)
    }
}

impl Detailed {
    /// Returns a detailed mesh of `pair`. `damping` applies to a force at the resultant of the face.
    pub fn new(
        pair: &Pair,
        spring: AnySpring,
        damping: Damping,
        face: Face,
        is_single: bool,
        friction: Option<ToothFriction>,
    ) -> Self {
        let (moment, resultant) = face.moment();
        let damping = damping.in_arcs(resultant, moment);
        let directions = Directions::new(pair);
        let whole = Node { cone: resultant, per_cone: 1.0 / resultant, weight: moment, width: face.width() };
        Self {
            whole,
            spring,
            damping,
            friction_face: face.is_distributed().then_some(face),
            face,
            is_single,
            friction,
            needs_thrust: true,
            has_seats: true,
            directions,
            moment,
            resultant,
        }
    }

    /// True if the law is valid at every cone distance, so that the load of aligned teeth grows with the cone distance.
    pub fn is_over_face(&self) -> bool {
        self.friction_face.is_some()
    }

    /// Sums the friction of flanks that fit over every point of `face`, over which the law is valid.
    pub fn set_friction_face(&mut self, face: Face) {
        self.friction_face = Some(face);
    }

    /// Replaces the damping.
    pub fn set_damping(&mut self, damping: Damping) {
        self.damping = damping.in_arcs(self.resultant, self.moment);
    }

    /// Loads at `state`.
    pub fn load(&self, teeth: &MeshTeeth, state: &DetailedState) -> DetailedLoad<f64> {
        let mut totals = Totals::<0, LOCAL>::default();
        with_spring!(&self.spring, spring => self.sum(spring, &mut totals, teeth, state, self.needs_thrust, |_| {}));
        totals.load()
    }

    /// Loads at `state` with their exact derivatives with respect to q, x, w and their rates.
    pub fn linearise(&self, teeth: &MeshTeeth, state: &DetailedState) -> DetailedLoad<Dual<LOCAL>> {
        let mut totals = Totals::<SUMS, LOCAL>::default();
        with_spring!(&self.spring, spring => self.sum(spring, &mut totals, teeth, state, self.needs_thrust, |_| {}));
        totals.linearised()
    }

    /// Loads at `state`; calls `look` with each loaded slice. It is compiled once for all laws and callers.
    pub fn look(
        &self,
        teeth: &MeshTeeth,
        state: &DetailedState,
        look: &mut dyn FnMut(&SliceLoad),
    ) -> DetailedLoad<f64> {
        let mut totals = Totals::<0, LOCAL>::default();
        self.sum(&self.spring, &mut totals, teeth, state, true, look);
        totals.load()
    }

    /// True if there may be gaps or excess material between the flanks of pairs.
    pub(super) fn is_open(&self, teeth: &MeshTeeth) -> bool {
        self.has_seats || teeth.gaps.is_some()
    }

    /// Opening of the flanks of pair `number` of `flank` at position `s` [rad] and cone distance `cone` [m], as an arc
    /// [rad].
    pub fn opened(
        &self,
        teeth: &MeshTeeth,
        state: &DetailedState,
        (flank, number, s): (Flank, i64, f64),
        cone: f64,
    ) -> f64 {
        let mut opening = self.opening(teeth, &teeth.name(flank, number, state.wrapped), s);
        if self.has_seats {
            opening.even.v += state.position[2] * self.directions.axial(&self.directions.arcs(s))[0];
        }
        opening.at(cone) / cone
    }

    /// Adds the loads of all pairs.
    #[inline(always)]
    fn sum<S: Spring, const ROWS: usize>(
        &self,
        spring: &S,
        totals: &mut Totals<ROWS, LOCAL>,
        teeth: &MeshTeeth,
        state: &DetailedState,
        needs_thrust: bool,
        mut look: impl FnMut(&SliceLoad),
    ) {
        let open = self.is_open(teeth);
        if open {
            self.each(teeth, state, [0.0; 2], |name, pair| {
                self.add::<_, ROWS, true>((spring, teeth, needs_thrust), totals, (name, pair), state, &mut look)
            });
        } else {
            self.each(teeth, state, [0.0; 2], |name, pair| {
                self.add::<_, ROWS, false>((spring, teeth, needs_thrust), totals, (name, pair), state, &mut look)
            });
        }
    }

    /// Elastic energy V [J].
    pub fn energy(&self, teeth: &MeshTeeth, state: &DetailedState) -> f64 {
        let (spring, mut energy) = (&self.spring, 0.0);
        self.each(teeth, state, [0.0; 2], |name, pair| {
            let mut opening = self.opening(teeth, name, pair.s);
            if self.has_seats {
                opening.even.v += state.position[2] * self.directions.axial(&self.directions.arcs(pair.s))[0];
            }
            let mut storage = PointStorage::default();
            let parts = self.face.loaded(pair.depth, &opening, &mut storage);
            if parts.iter().all(Part::is_empty) {
                return;
            }
            let local = spring.local(pair.s);
            for part in parts {
                for node in part.nodes {
                    let arc = pair.depth - opening.turn - part.even * node.per_cone - opening.bend * node.cone;
                    if arc > 0.0 {
                        energy += node.weight * spring.respond(&local, arc).energy;
                    }
                }
            }
        });
        energy
    }

    /// Calls `visit` with each pair that touches or is within `margin` [rad] of touching. `margin` has one value for
    /// drive flanks and one for coast flanks.
    #[inline(always)]
    pub(super) fn each(
        &self,
        teeth: &MeshTeeth,
        state: &DetailedState,
        margin: [f64; 2],
        mut visit: impl FnMut(&PairName, &ToothPair),
    ) {
        let [q, x, w] = state.position;
        // upper bound by which errors and axial displacement bring flanks nearer than error-free ones [m], then [rad]
        let slack = teeth.gaps.map_or(0.0, |g| -g.least) + (-w).max(0.0);
        let slack = slack / self.face.inner();
        for ((flank, sign), margin) in [(Flank::Drive, -1.0), (Flank::Coast, 1.0)].into_iter().zip(margin) {
            let excess = slack + margin;
            let approach = q * sign - teeth.engagement.half_backlash();
            if approach + excess <= 0.0 {
                continue;
            }
            let mut see = |pair: &ToothPair| visit(&teeth.name(flank, pair.number, state.wrapped), pair);
            if self.is_single {
                see(&ToothPair::single(flank, approach));
            } else {
                teeth.engagement.near(flank, x, approach + excess, excess, see);
            }
        }
    }

    #[inline(always)]
    pub(super) fn opening(&self, teeth: &MeshTeeth, name: &PairName, s: f64) -> Opening {
        teeth.gaps.map_or(Opening::NONE, |gaps| gaps.opening(name, s))
    }

    /// Opening of the flanks of a pair, ν and ∂ν/∂s of its side gear's axial displacement, and its arcs, which are
    /// computed only with axial seats.
    #[inline(always)]
    pub(super) fn opened_pair(&self, teeth: &MeshTeeth, name: &PairName, s: f64, w: f64) -> (Opening, [f64; 2], Arcs) {
        let mut opening = self.opening(teeth, name, s);
        if !self.has_seats {
            return (opening, [0.0; 2], Arcs::NONE);
        }
        let arcs = self.directions.arcs(s);
        let axial = self.directions.axial(&arcs);
        opening.displace(w, axial);
        (opening, axial, arcs)
    }

    /// The loaded parts of the face if the flanks approach by `depth` [rad]. `storage` is for the points of partly
    /// loaded faces.
    #[inline(always)]
    pub(super) fn loaded_parts<'a, const OPEN: bool>(
        &'a self,
        depth: f64,
        opening: &Opening,
        storage: &'a mut PointStorage,
    ) -> [Part<'a>; 2] {
        if OPEN {
            self.face.loaded(depth, opening, storage)
        } else if depth > 0.0 {
            [Part::of(&self.whole), Part::NONE]
        } else {
            [Part::NONE; 2]
        }
    }

    /// Adds the loads of a pair.
    #[inline(always)]
    fn add<S: Spring, const ROWS: usize, const OPEN: bool>(
        &self,
        (spring, teeth, needs_thrust): (&S, &MeshTeeth, bool),
        totals: &mut Totals<ROWS, LOCAL>,
        (name, pair): (&PairName, &ToothPair),
        state: &DetailedState,
        look: impl FnMut(&SliceLoad),
    ) {
        let (mut opening, mut axial, mut arcs) = (Opening::NONE, [0.0; 2], Arcs::NONE);
        let mut storage = PointStorage::default();
        if OPEN {
            (opening, axial, arcs) = self.opened_pair(teeth, name, pair.s, state.position[2]);
        }
        let parts = self.loaded_parts::<OPEN>(pair.depth, &opening, &mut storage);
        // most nearby pairs do not touch
        if parts.iter().all(Part::is_empty) {
            return;
        }
        let motion = PairMotion::<OPEN, false>::new(pair, &opening, axial, state);
        let touching = Touching { name, pair, local: None, opening: &opening, arcs, parts, motion };
        self.add_touching((spring, teeth, needs_thrust), totals, touching, look);
    }
}

impl Spot {
    /// Slopes with respect to q and x of the position on the path, or of the arc past its end: the normal's direction
    /// depends on it. `sign` is ∂a/∂q, `s_slope` is ∂s/∂x.
    pub(super) fn moves(self, sign: f64, s_slope: f64) -> [f64; 2] {
        match self {
            Spot::Path | Spot::PlanetTip => [0.0, s_slope],
            Spot::SideTip => [sign, -s_slope],
        }
    }
}

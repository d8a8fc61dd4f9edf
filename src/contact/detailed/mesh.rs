//! The detailed mesh: its constants, and the search for its tooth pairs.

use super::directions::Directions;
use super::face::{Face, Part, PointStorage};
use super::{DetailedState, Node, Opening, PairName};
use crate::contact::{AnySpring, Damping, Engagement, Flank, FlankGaps, Spot, ToothFriction, ToothPair};
use crate::geometry::Pair;

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

/// Teeth of a mesh in their present condition: tooth pairs, errors, oil viscosity, planet and side gear.
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
    pub(super) fn name(&self, flank: Flank, number: i64, wrapped: i64) -> PairName {
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

    /// Upper bound by which errors and axial displacement bring flanks nearer than error-free ones [rad].
    #[inline(always)]
    pub(super) fn slack(&self, teeth: &MeshTeeth, state: &DetailedState) -> f64 {
        (teeth.gaps.map_or(0.0, |g| -g.least) + (-state.position[2]).max(0.0)) / self.face.inner()
    }

    /// Calls `visit` with each pair that would touch if its flanks were nearer by `excess` [rad]. `excess` has one value
    /// for drive flanks and one for coast flanks.
    #[inline(always)]
    pub(super) fn each(
        &self,
        teeth: &MeshTeeth,
        state: &DetailedState,
        excess: [f64; 2],
        mut visit: impl FnMut(&PairName, &ToothPair),
    ) {
        let [q, x, _] = state.position;
        for ((flank, sign), excess) in [(Flank::Drive, -1.0), (Flank::Coast, 1.0)].into_iter().zip(excess) {
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

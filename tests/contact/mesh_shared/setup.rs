//! Both meshes of a planet on the bodies of its gears, and random states.

use crate::random::Draws;
use bevel_differential::contact::bodies::{MeshOnBodies, PairCouplings, Support};
use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::detailed::{
    Detailed, DetailedState, Face as CutFace, Gaps, MeshTeeth, Opening, PairName, SharedTeeth, Slice,
};
use bevel_differential::contact::gaps::FlankGaps;
use bevel_differential::contact::law::FaceLaw;
use bevel_differential::contact::laws::AnySpring;
use bevel_differential::contact::mesh::{Law, Mesh, MeshState};
use bevel_differential::contact::pairs::{Engagement, Flank};
use bevel_differential::contact::shared::{SharedForce, SharedMeshes};
use bevel_differential::contact::stiffness::{Elasticity, PairStiffness, RootSpec};
use bevel_differential::contact::tooth_friction::ToothFriction;
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::numeric::Jet;
use fastrand::Rng;

pub const STEEL: Elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };
pub const UNDAMPED: Damping = Damping::Step { coefficient: 0.0, per_full_depth: 1e4 };
pub const STEP: Damping = Damping::Step { coefficient: 5e4, per_full_depth: 1e4 };
pub const RESTITUTION: Damping = Damping::HuntCrossley { lambda: 3.6 };
/// Line load of Hertz's part at the mean cone distance [N/m].
pub const LINE_LOAD: f64 = 4e5;

/// MeshTeeth of planet and side gear, bores [m], backlash [m].
pub const GEARS: [([i32; 2], [f64; 2], f64); 4] = [
    ([10, 16], [0.016, 0.03], 1e-4),
    ([9, 14], [0.01, 0.02], 0.0),
    ([11, 15], [0.0, 0.0], 5e-5),
    ([10, 16], [0.018, 0.03], 0.0),
];

/// Planets on the side gear.
pub const PLANETS: u32 = 2;

/// A law and its damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Line,
    LineWeber,
}

/// A loaded slice as far as it must stay the same.
pub type Loaded = (PairName, u8, u64, bool, bool, [bool; 2]);

/// Gears with elastic bodies.
pub struct Gears {
    pub pair: Pair,
    pub on_bodies: MeshOnBodies,
    pub stiffness: PairStiffness,
    pub bodies: PairCouplings,
    pub teeth: FlankGaps,
    pub mesh: Mesh,
    pub detailed: Detailed,
    pub moment: f64,
}

impl Gears {
    pub fn new(
        (teeth, bores, backlash): ([i32; 2], [f64; 2], f64),
        kind: Kind,
        damping: Damping,
        cut: bool,
        friction: Option<ToothFriction>,
    ) -> Self {
        let spec = GearSpec { planet_teeth: teeth[0], side_teeth: teeth[1], backlash, ..GearSpec::default() };
        let pair = Pair::new(&spec);
        let sections = PairStiffness::teeth(&pair, &RootSpec::default(), STEEL).expect("teeth");
        let supports = [Support::FreeBore(bores[0]), Support::Bore(bores[1])];
        let on_bodies = MeshOnBodies::new(&pair, &sections, supports, PLANETS).expect("bodies");
        let stiffness =
            PairStiffness::of_gears(&pair, &sections, LINE_LOAD, |i, roll| on_bodies.gear(i, roll)).expect("teeth");
        let bodies = PairCouplings::new(
            &on_bodies,
            [stiffness.path, stiffness.range],
            (pair.centred_position(), pair.base_pitch),
        );
        let (outer, inner) = (pair.outer_cone, pair.inner_cone);
        let moment = (outer.powi(3) - inner.powi(3)) / 3.0;
        let cone = 2.0 * moment / (outer * outer - inner * inner);
        let whole = CutFace::whole(Slice { cone, weight: moment, width: (outer - inner) * pair.mean_cone / cone });
        let (law, spring, face) = match kind {
            Kind::Line => {
                let specific = stiffness.line();
                let spring = AnySpring::Line(specific.clone());
                (
                    Law::Line(FaceLaw { specific, moment, per_cone: 1.0 / cone, damping }),
                    spring,
                    CutFace::cut(inner, outer),
                )
            }
            Kind::LineWeber => {
                let specific = stiffness.line_weber();
                let spring = AnySpring::LineWeber(specific.clone());
                let law = Law::LineWeber(FaceLaw { specific, moment, per_cone: 1.0 / cone, damping });
                (law, spring, CutFace::sliced(inner, outer))
            }
        };
        let mesh = Mesh { law, cone, engagement: Engagement::new(&pair, true, 0.05) };
        let mut detailed = Detailed::new(&pair, spring, damping, if cut { face } else { whole }, false, friction);
        (detailed.has_seats, detailed.needs_thrust) = (cut, cut);
        let teeth = FlankGaps::perfect(&pair, 2);
        Self { pair, on_bodies, stiffness, bodies, teeth, mesh, detailed, moment }
    }

    fn meshes(&self) -> SharedMeshes<'_> {
        SharedMeshes { mesh: &self.mesh, bodies: &self.bodies, opposite: self.teeth.opposite(0), wrapped: [0; 2] }
    }

    /// Forces with derivatives; without them they are the same.
    pub fn force(&self, states: &[MeshState; 2]) -> SharedForce {
        let (found, plain) = match &self.mesh.law {
            Law::Line(law) => (self.meshes().linearise(law, states), self.meshes().force(law, states)),
            Law::LineWeber(law) => (self.meshes().linearise(law, states), self.meshes().force(law, states)),
            other => panic!("{other:?}"),
        };
        for (found, plain) in found.force.iter().zip(&plain) {
            assert_eq!((found.force, found.heat), (plain.force, plain.heat));
        }
        found
    }

    pub fn energy(&self, states: &[MeshState; 2]) -> f64 {
        match &self.mesh.law {
            Law::Line(law) => self.meshes().energy(law, states),
            Law::LineWeber(law) => self.meshes().energy(law, states),
            other => panic!("{other:?}"),
        }
    }

    /// Calls `act` with the teeth of both meshes.
    pub fn shared<R>(&self, gaps: Option<&dyn Gaps>, act: impl FnOnce(&SharedTeeth) -> R) -> R {
        let teeth =
            [0, 1].map(|side| MeshTeeth { engagement: &self.mesh.engagement, gaps, viscosity: None, planet: 0, side });
        act(&SharedTeeth { teeth, bodies: &self.bodies, opposite: self.teeth.opposite(0) })
    }

    /// Loaded slices: teeth, kind of contact, place on the face, whether damping is full, and which ends of the face carry;
    /// where this changes, derivatives jump or bend. Nothing if one that stands still, or the deepest of those that move with a
    /// part of the face, is less than `least` deep [rad].
    pub fn pattern(&self, gaps: Option<&dyn Gaps>, states: &[DetailedState; 2], least: f64) -> Option<Vec<Loaded>> {
        let (mut pattern, mut shallow) = (Vec::new(), false);
        let mut deepest: Vec<(PairName, f64)> = Vec::new();
        let ends = self.detailed.face.ends().unwrap_or([self.mesh.cone; 2]);
        let fixed: Vec<u64> = match &self.detailed.face {
            CutFace::Whole(node) => vec![node.cone.to_bits()],
            CutFace::Cut(_, nodes) => nodes.iter().map(|node| node.cone.to_bits()).collect(),
            CutFace::Sliced(_, nodes) => nodes.iter().map(|node| node.cone.to_bits()).collect(),
        };
        self.shared(gaps, |teeth| {
            self.detailed.look_shared(teeth, states, &mut |slice| {
                let place = Some(slice.cone.to_bits()).filter(|place| fixed.contains(place)).unwrap_or(0);
                let full = slice.arc * slice.cone * 1e4 >= 1.0;
                match deepest.iter_mut().find(|(name, _)| *name == slice.name) {
                    _ if place != 0 => shallow |= slice.arc < least,
                    Some((_, arc)) => *arc = arc.max(slice.arc),
                    None => deepest.push((slice.name, slice.arc)),
                }
                let carry = ends.map(|end| slice.approach.arc - slice.opening.at(end) / end > 0.0);
                pattern.push((slice.name, slice.spot as u8, place, slice.normal <= 0.0, full, carry));
            })
        });
        shallow |= deepest.iter().any(|(_, arc)| *arc < least);
        (!shallow).then_some(pattern)
    }
}

/// Gaps that differ from tooth to tooth and over the face and are smooth along the path.
#[derive(Debug)]
pub struct Waves(pub f64);

impl Gaps for Waves {
    fn opening(&self, name: &PairName, s: f64) -> Opening {
        let phase = name.tooth as f64 * 1.3 + name.side as f64 + if name.flank == Flank::Drive { 0.0 } else { 0.7 };
        let (k, size) = (9.0, self.0);
        let (sin, cos) = (k * s + phase).sin_cos();
        let even = Jet { v: size * sin, d: size * k * cos, dd: -size * k * k * sin };
        Opening { even, turn: 10.0 * size * phase.cos(), bend: 50.0 * size * (1.0 + phase.sin()), edge: None }
    }
    fn least(&self) -> f64 {
        -1.5 * self.0
    }
}

/// A state of both meshes: each on either flank, a third of them within the lash or barely out of it.
pub fn random_states(random: &mut Rng, pair: &Pair, w: f64) -> [DetailedState; 2] {
    [0, 1].map(|_| {
        let depth =
            if random.between(0.0, 3.0) < 1.0 { random.between(-3e-4, 3e-4) } else { random.between(1e-5, 2e-3) };
        let hand = if random.between(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 };
        let between = |random: &mut Rng, size: f64| random.between(-size, size);
        let axial = if w == 0.0 { [0.0; 2] } else { [between(random, w), between(random, 0.02)] };
        DetailedState {
            position: [
                hand * (pair.normal_backlash / 2.0 + depth).max(0.0),
                between(random, 2.0 * pair.base_pitch),
                axial[0],
            ],
            rate: [between(random, 1.0), between(random, 1.0), axial[1]],
            wrapped: 0,
        }
    })
}

pub fn plain(states: &[DetailedState; 2]) -> [MeshState; 2] {
    states.map(|state| {
        let ([q, x, _], [q_rate, x_rate, _]) = (state.position, state.rate);
        MeshState { position: [q, x], rate: [q_rate, x_rate], ..MeshState::default() }
    })
}

/// States with the position (0 to 2) or rate (3 to 5) `i` of the mesh `side` moved by `h`.
pub fn shifted(states: &[DetailedState; 2], side: usize, i: usize, h: f64) -> [DetailedState; 2] {
    let mut states = *states;
    let state = &mut states[side];
    if i < 3 {
        state.position[i] += h
    } else {
        state.rate[i - 3] += h
    }
    states
}

/// Central difference of fourth order.
pub fn difference(
    states: &[DetailedState; 2],
    (side, i): (usize, usize),
    h: f64,
    f: impl Fn(&[DetailedState; 2]) -> f64,
) -> f64 {
    let at = |k: f64| f(&shifted(states, side, i, k * h));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}

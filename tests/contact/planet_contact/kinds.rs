//! Kinds of contact of a planet with both side gears, and the one interface to the library's evaluators.
//!
//! A new kind of contact is a line in [`kinds`]. No other file of this suite names an evaluator.

use std::sync::{Arc, LazyLock};

use bevel_differential::contact::bodies::{MeshOnBodies, PairCouplings, Support};
use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::detailed::{
    Detailed, DetailedLoad, DetailedState, Face as FacePoints, Gaps, MeshTeeth, Opening, PairName, SharedTeeth,
    SliceLoad,
};
use bevel_differential::contact::errors::{Chip, FaultyGear, ToothErrorSpec, ToothErrors, ToothFaultSpec};
use bevel_differential::contact::mesh::{Law, Mesh, MeshForce, MeshState};
use bevel_differential::contact::shared::{SharedForce, SharedMeshes};
use bevel_differential::contact::stiffness::{Elasticity, PairStiffness, RootSpec};
use bevel_differential::contact::{Engagement, FlankGaps, Spring, ToothFriction, ToothPair};
use bevel_differential::friction::{FrictionLaw, ToothFrictionSpec};
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::numeric::{Dual, Jet};

use crate::mesh_laws::{Built, Kind, PER_FULL_DEPTH, RESTITUTION, STEP, UNDAMPED};
use crate::tooth_errors::every_kind;

pub const STEEL: Elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };
/// Line load of Hertz's part at the mean cone distance [N/m].
const LINE_LOAD: f64 = 4e5;
/// Laws of elastic teeth, which are valid at every cone distance and on elastic bodies.
pub const OF_TEETH: [Kind; 2] = [Kind::Line, Kind::LineWeber];
/// The planet of the tests, the number of planets, and pairs by which its position was wrapped, in the sense of x of each mesh.
const PLANET: usize = 1;
const PLANETS: usize = 2;
const WRAPPED: [i64; 2] = [3, -3];

/// Position [q, x, w] and rates of the left and the right mesh.
#[derive(Clone, Copy, Debug)]
pub struct At {
    pub position: [[f64; 3]; 2],
    pub rate: [[f64; 3]; 2],
}

/// Forces conjugate to q, x, w of each mesh, then its normal force, thrust on planet and side gear, and tangential force, which
/// are zero under plain kinds; and its heat of contact and of friction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forces {
    pub readings: [[f64; 7]; 2],
    pub heat: [[f64; 2]; 2],
}

/// Derivatives of the readings of both meshes with respect to [q, x, w] left and right, then to their rates, and the energy.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slopes {
    pub by: [[[f64; 12]; 7]; 2],
    pub energy: f64,
}

/// Evaluator: a plain mesh, or one in detail with one resultant or with loads over the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Face {
    Plain,
    Whole,
    Cut,
}

/// Perfect teeth; teeth with errors, and with so much [m] missing of half the face of one; or the same opening at every pair.
#[derive(Clone, Copy, Debug)]
pub enum Teeth {
    Perfect,
    Made(ToothErrorSpec, f64),
    Alike(Opening),
}

/// A kind of contact; side gears that are displaced move along their axes.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    pub law: Kind,
    pub damping: Damping,
    pub face: Face,
    pub teeth: Teeth,
    pub friction: Option<ToothFrictionSpec>,
    pub is_displaced: bool,
    pub is_elastic: bool,
    pub has_corners: bool,
}

/// Plain teeth with the law `line`.
pub const PLAIN: Contact = Contact {
    law: Kind::Line,
    damping: UNDAMPED,
    face: Face::Plain,
    teeth: Teeth::Perfect,
    friction: None,
    is_displaced: false,
    is_elastic: false,
    has_corners: true,
};

pub fn coulomb(coefficient: f64, regularisation_speed: f64) -> Option<ToothFrictionSpec> {
    Some(ToothFrictionSpec { coefficient, regularisation_speed, ..ToothFrictionSpec::default() })
}

/// All kinds of contact.
pub fn kinds() -> Vec<Contact> {
    let xu = ToothFrictionSpec { law: FrictionLaw::XuKahraman, regularisation_speed: 0.05, ..Default::default() };
    let dissipation =
        [(UNDAMPED, None), (STEP, None), (RESTITUTION, None), (RESTITUTION, coulomb(0.07, 0.05)), (STEP, Some(xu))];
    // and so much damping that flanks often let go
    let stepping = Damping::Step { coefficient: 1e7, per_full_depth: PER_FULL_DEPTH };
    let dampings = [UNDAMPED, STEP, RESTITUTION, stepping, Damping::HuntCrossley { lambda: 60.0 }];
    let spec = ToothErrorSpec::default();
    let teeth = [
        Teeth::Perfect,
        Teeth::Made(ToothErrorSpec { crowning: 2e-5, ..spec }, 0.0),
        Teeth::Made(ToothErrorSpec { crowning: 2e-4, side_axial_offset: 2e-5, ..spec }, 0.0),
        Teeth::Made(ToothErrorSpec { shaft_angle_error: 5e-4, axis_offset: -2e-5, ..spec }, 0.0),
        Teeth::Made(ToothErrorSpec { accuracy_grade: 8, runout_by_grade: true, seed: 3, ..spec }, 1e-3),
        Teeth::Made(spec, 1e-3),
        Teeth::Made(spec, 4e-6),
        Teeth::Made(every_kind(), 0.0),
        Teeth::Alike(Opening { even: Jet { v: -5e-5, d: 0.0, dd: 0.0 }, ..Opening::NONE }),
    ];
    let mut kinds = Vec::new();
    for law in [Kind::Impact, Kind::DampedImpact, Kind::Line, Kind::LineWeber, Kind::Lumped] {
        let is_of_teeth = OF_TEETH.contains(&law);
        for is_elastic in [false, true].into_iter().filter(|is_elastic| is_of_teeth || !is_elastic) {
            let plain = Contact { law, is_elastic, ..PLAIN };
            kinds.extend(dampings.map(|damping| Contact { damping, ..plain }));
            for (damping, friction) in dissipation {
                let whole = Contact { damping, friction, face: Face::Whole, ..plain };
                kinds.push(whole);
                let face = if is_of_teeth { Face::Cut } else { Face::Whole };
                for is_displaced in [false, true] {
                    kinds.extend(teeth.map(|teeth| Contact { face, teeth, is_displaced, ..whole }));
                }
            }
        }
        kinds.push(Contact { law, has_corners: false, ..PLAIN });
    }
    // IMPACT has its own damping
    kinds.retain(|kind| kind.law != Kind::Impact || matches!(kind.damping, Damping::Step { .. }));
    kinds
}

/// A pair of gears with the exponent of IMPACT: stiff and with elastic bodies, without and with contact of tip corners.
pub struct Gears {
    pub pair: Pair,
    pub exponent: f64,
    teeth: FlankGaps,
    pub stiffness: [PairStiffness; 2],
    pub on_bodies: MeshOnBodies,
    pub couplings: PairCouplings,
    engagements: [Engagement; 2],
}

pub static GEARS: LazyLock<[Arc<Gears>; 4]> = LazyLock::new(|| {
    [
        Gears::new([10, 16], [0.016, 0.03], 1.5, 1e-4),
        Gears::new([9, 14], [0.01, 0.02], 1.5, 0.0),
        Gears::new([11, 15], [0.0, 0.0], 2.2, 5e-5),
        Gears::new([10, 16], [0.018, 0.03], 1.5, 0.0),
    ]
});

impl Gears {
    /// Gears with `teeth`, `bores` [m] and `backlash` [m].
    pub fn new([planet_teeth, side_teeth]: [i32; 2], bores: [f64; 2], exponent: f64, backlash: f64) -> Arc<Self> {
        let pair = Pair::new(&GearSpec { planet_teeth, side_teeth, backlash, ..GearSpec::default() });
        let sections = PairStiffness::teeth(&pair, &RootSpec::default(), STEEL).unwrap();
        let supports = [Support::FreeBore(bores[0]), Support::Bore(bores[1])];
        let on_bodies = MeshOnBodies::new(&pair, &sections, supports, PLANETS as u32).unwrap();
        let elastic = PairStiffness::of_gears(&pair, &sections, LINE_LOAD, |i, roll| on_bodies.gear(i, roll)).unwrap();
        let stiff = PairStiffness::new(&pair, &RootSpec::default(), STEEL.young, STEEL.poisson, LINE_LOAD).unwrap();
        let phase = (pair.centred_position(), pair.base_pitch);
        let couplings = PairCouplings::new(&on_bodies, [elastic.path, elastic.range], phase);
        let engagements = [false, true].map(|corners| Engagement::new(&pair, corners, 0.05));
        let teeth = FlankGaps::perfect(&pair, PLANETS as i32);
        Arc::new(Self { pair, exponent, teeth, stiffness: [stiff, elastic], on_bodies, couplings, engagements })
    }

    /// Number of the planet's tooth that stands at the right mesh's line as tooth 0 does at the left one's.
    pub fn opposite(&self) -> i64 {
        self.teeth.opposite(PLANET)
    }

    fn gaps(&self, teeth: &Teeth) -> Option<Box<dyn Gaps>> {
        let (spec, depth) = match *teeth {
            Teeth::Perfect => return None,
            Teeth::Alike(opening) => return Some(Box::new(Alike(opening))),
            Teeth::Made(spec, depth) => (spec, depth),
        };
        let errors = ToothErrors::new(&spec, &self.pair, PLANETS).unwrap();
        let (gear, index, tooth) = (FaultyGear::Planet, PLANET as i32, self.pair.gears[0].teeth - WRAPPED[0] as i32);
        let fault = ToothFaultSpec { gear, index, tooth, depth, ..Default::default() };
        let mut gaps = self.teeth.clone();
        gaps.chip = Chip::new(&fault, &self.pair, PLANETS).unwrap().filter(|_| depth > 0.0);
        (gaps.least, gaps.errors) = (-errors.most_excess(self.pair.outer_cone), Some(errors));
        Some(Box::new(gaps))
    }
}

#[derive(Debug)]
struct Alike(Opening);

impl Gaps for Alike {
    fn opening(&self, _: &PairName, _: f64) -> Opening {
        self.0
    }
    fn least(&self) -> f64 {
        -2e-4
    }
}

/// A planet that meshes with both side gears, under one kind of contact.
pub struct Planet {
    pub contact: Contact,
    pub gears: Arc<Gears>,
    pub mesh: Mesh,
    detailed: Detailed,
    gaps: Option<Box<dyn Gaps>>,
}

/// Evaluates an expression with `law` bound to a law of elastic teeth.
macro_rules! of_teeth {
    ($of:expr, $law:ident => $body:expr) => {
        match &$of.mesh.law {
            Law::Line($law) => $body,
            Law::LineWeber($law) => $body,
            other => panic!("{other:?} has no elastic bodies"),
        }
    };
}

fn plain_forces(of: [MeshForce; 2]) -> Forces {
    let readings = of.map(|MeshForce { force: [q, x], .. }| [q, x, 0.0, 0.0, 0.0, 0.0, 0.0]);
    Forces { readings, heat: of.map(|of| [of.heat, 0.0]) }
}

fn readings<T: Copy>(of: &DetailedLoad<T>) -> [T; 7] {
    let [q, x, w] = of.force;
    [q, x, w, of.normal, of.planet_axial, of.side_axial, of.tangential]
}

fn detailed_forces(of: [DetailedLoad<f64>; 2]) -> Forces {
    Forces { readings: of.each_ref().map(readings), heat: of.map(|of| of.heat) }
}

/// Forces and slopes of loads with derivatives by q, x, w and their rates, and by q, x, w of the other mesh if there are more.
fn detailed_slopes<const N: usize>(of: [DetailedLoad<Dual<N>>; 2]) -> (Forces, Slopes) {
    let mut slopes = Slopes { energy: of[0].energy + of[1].energy, ..Slopes::default() };
    for side in 0..2 {
        for (by, reading) in slopes.by[side].iter_mut().zip(readings(&of[side])) {
            by[3 * side..][..3].copy_from_slice(&reading.d[..3]);
            by[6 + 3 * side..][..3].copy_from_slice(&reading.d[3..6]);
            by[3 - 3 * side..][..N - 6].copy_from_slice(&reading.d[6..]);
        }
    }
    (detailed_forces(of.map(|of| of.map(|x| x.v))), slopes)
}

impl Planet {
    pub fn new(contact: Contact, gears: &Arc<Gears>) -> Self {
        let (pair, stiffness) = (&gears.pair, &gears.stiffness[usize::from(contact.is_elastic)]);
        let Built { law, spring, whole, cone } =
            Built::of(pair, stiffness, contact.law, gears.exponent, contact.damping);
        let mesh = Mesh { law, cone, engagement: gears.engagements[usize::from(contact.has_corners)].clone() };
        let cut = if contact.law == Kind::Line { FacePoints::cut } else { FacePoints::sliced };
        let cut = cut(pair.inner_cone, pair.outer_cone);
        let face = if contact.face == Face::Cut { cut } else { FacePoints::whole(whole) };
        let friction = contact.friction.map(|spec| ToothFriction { spec, modulus: 0.5 * STEEL.plane_modulus() });
        let is_single = contact.law == Kind::Lumped;
        let mut detailed = Detailed::new(pair, spring, contact.damping, face, is_single, friction);
        detailed.has_seats = contact.is_displaced;
        if OF_TEETH.contains(&contact.law) {
            detailed.rub_over(cut);
        }
        Self { gaps: gears.gaps(&contact.teeth), contact, gears: gears.clone(), mesh, detailed }
    }

    fn states(&self, at: &At) -> [DetailedState; 2] {
        [0, 1].map(|side| DetailedState { position: at.position[side], rate: at.rate[side], wrapped: WRAPPED[side] })
    }

    fn plain_states(&self, at: &At) -> [MeshState; 2] {
        self.states(at).map(|DetailedState { position: [q, x, _], rate: [dq, dx, _], .. }| MeshState {
            position: [q, x],
            rate: [dq, dx],
            ..MeshState::default()
        })
    }

    fn teeth(&self, side: usize) -> MeshTeeth<'_> {
        let (engagement, gaps) = (&self.mesh.engagement, self.gaps.as_deref());
        MeshTeeth { engagement, gaps, viscosity: None, planet: PLANET, side }
    }

    fn plain_on_bodies(&self) -> SharedMeshes<'_> {
        let (bodies, opposite) = (&self.gears.couplings, self.gears.opposite());
        SharedMeshes { mesh: &self.mesh, bodies, opposite, wrapped: WRAPPED }
    }

    fn on_bodies<R>(&self, act: impl FnOnce(&SharedTeeth) -> R) -> R {
        let numbers = &|name| self.gears.teeth.unrolled(&name)[0];
        act(&SharedTeeth { teeth: [self.teeth(0), self.teeth(1)], bodies: &self.gears.couplings, numbers })
    }

    pub fn forces(&self, at: &At) -> Forces {
        let (states, plain) = (self.states(at), self.plain_states(at));
        match (self.contact.face, self.contact.is_elastic) {
            (Face::Plain, false) => plain_forces(plain.map(|state| self.mesh.force(&state))),
            (Face::Plain, true) => plain_forces(of_teeth!(self, law => self.plain_on_bodies().force(law, &plain))),
            (_, false) => detailed_forces([0, 1].map(|side| self.detailed.load(&self.teeth(side), &states[side]))),
            (_, true) => detailed_forces(self.on_bodies(|teeth| self.detailed.load_shared(teeth, &states))),
        }
    }

    pub fn linearised(&self, at: &At) -> (Forces, Slopes) {
        let (states, plain) = (self.states(at), self.plain_states(at));
        let found = match (self.contact.face, self.contact.is_elastic) {
            (Face::Plain, true) => of_teeth!(self, law => self.plain_on_bodies().linearise(law, &plain)),
            (Face::Plain, false) => {
                let ([left, right], none) = (plain.map(|state| self.mesh.linearise(&state)), [[0.0; 2]; 2]);
                SharedForce {
                    force: [left.0, right.0],
                    by_position: [[left.1.by_position, none], [none, right.1.by_position]],
                    by_rate: [left.1.by_rate, right.1.by_rate],
                    energy: left.1.energy + right.1.energy,
                }
            }
            (_, true) => {
                return detailed_slopes(self.on_bodies(|teeth| self.detailed.linearise_shared(teeth, &states)));
            }
            (_, false) => {
                return detailed_slopes([0, 1].map(|side| self.detailed.linearise(&self.teeth(side), &states[side])));
            }
        };
        let mut slopes = Slopes { energy: found.energy, ..Slopes::default() };
        for (side, a) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let row = &mut slopes.by[side][a];
            row[..2].copy_from_slice(&found.by_position[side][0][a]);
            row[3..5].copy_from_slice(&found.by_position[side][1][a]);
            row[6 + 3 * side..][..2].copy_from_slice(&found.by_rate[side][a]);
        }
        (plain_forces(found.force), slopes)
    }

    pub fn energy(&self, at: &At) -> f64 {
        let (states, plain) = (self.states(at), self.plain_states(at));
        match (self.contact.face, self.contact.is_elastic) {
            (Face::Plain, false) => plain.iter().map(|state| self.mesh.energy(state)).sum(),
            (Face::Plain, true) => of_teeth!(self, law => self.plain_on_bodies().energy(law, &plain)),
            (_, false) => (0..2).map(|side| self.detailed.energy(&self.teeth(side), &states[side])).sum(),
            (_, true) => self.on_bodies(|teeth| self.detailed.energy_shared(teeth, &states)),
        }
    }

    /// Calls `visit` with each loaded point of a face. Those of a plain mesh are taken from the same mesh in detail.
    pub fn loaded(&self, at: &At, mut visit: impl FnMut(&SliceLoad)) {
        let states = self.states(at);
        if self.contact.is_elastic {
            self.on_bodies(|teeth| self.detailed.look_shared(teeth, &states, &mut visit));
        } else {
            (0..2).for_each(|side| _ = self.detailed.look(&self.teeth(side), &states[side], &mut visit));
        }
    }

    /// Normal forces of the pairs that a plain kind visits.
    pub fn plain_normal(&self, at: &At, side: usize) -> f64 {
        let (states, mut sum) = (self.plain_states(at), 0.0);
        if self.contact.is_elastic {
            of_teeth!(self, law => self.plain_on_bodies().loaded(law, &states, side, &mut |_, force| sum += force.total));
        } else {
            self.mesh.loaded(&states[side], |_, force| sum += force.total);
        }
        sum
    }

    /// The cone distance of a point of a face, unless it moves with the loaded part, and whether both ends of the face, and the
    /// edge of a broken tooth on both sides, are loaded.
    pub fn fixed(&self, point: &SliceLoad) -> (Option<f64>, [bool; 4]) {
        let is_fixed = |cone: f64| cone == self.mesh.cone || self.detailed.face.nodes().iter().any(|n| n.cone == cone);
        let [inner, outer] = self.detailed.face.ends().unwrap_or([self.mesh.cone; 2]);
        let (edge, depth) = point.opening.edge.unwrap_or((outer, 0.0));
        let ends = [(inner, 0.0), (outer, 0.0), (edge, 0.0), (edge, depth)];
        let is_loaded = |(end, missing)| point.approach.arc - (point.opening.at(end) + missing) / end > 0.0;
        (Some(point.cone).filter(|cone| is_fixed(*cone)), ends.map(is_loaded))
    }

    /// Pairs of perfect teeth of the mesh `side` that touch.
    pub fn pairs(&self, at: &At, side: usize) -> Vec<ToothPair> {
        let ([q, x, _], mut pairs) = (at.position[side], Vec::new());
        self.mesh.engagement.pairs([q, x], |pair| pairs.push(*pair));
        pairs
    }

    /// Elastic torque per ∫R² dR of teeth at the arc `arc` and the place `s` [rad].
    pub fn torque(&self, arc: f64, s: f64) -> f64 {
        self.detailed.spring.at(arc, s).torque
    }
}

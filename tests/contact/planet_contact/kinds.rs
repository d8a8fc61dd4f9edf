//! Kinds of contact of a planet with both side gears, and the single interface to the library's evaluators.
//!
//! A new kind of contact is a line in [`kinds`]. No other file of this suite refers to an evaluator.

use std::sync::{Arc, LazyLock};

use bevel_differential::contact::bodies::{MeshOnBodies, PairCouplings, Support};
use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::detailed::{Detailed, Opening, PairName, SliceLoad};
use bevel_differential::contact::errors::{Chip, FaultyGear, ToothErrorSpec, ToothErrors, ToothFaultSpec};
use bevel_differential::contact::planet::{
    self, AnyContact, LinearisedLoad, MeshLoad, PlanetContact, PlanetState, Pressing, Visit,
};
use bevel_differential::contact::stiffness::{Elasticity, PairStiffness, RootSpec};
use bevel_differential::contact::{Engagement, Flank, FlankGaps, Mesh, Spring, ToothFriction, ToothLoad, ToothPair};
use bevel_differential::friction::{FrictionLaw, ToothFrictionSpec};
use bevel_differential::geometry::{GearSpec, Pair};

use crate::mesh_laws::{Built, Kind, PER_FULL_DEPTH, RESTITUTION, STEP, UNDAMPED};
use crate::tooth_errors::every_kind;

pub const STEEL: Elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };
/// Line load of the Hertz part at the mean cone distance [N/m].
const LINE_LOAD: f64 = 4e5;
/// Laws of elastic teeth, which are valid at every cone distance and on elastic bodies.
pub const OF_TEETH: [Kind; 2] = [Kind::Line, Kind::LineWeber];
/// Index of the tested planet.
const PLANET: usize = 1;
/// Number of planets.
const PLANETS: usize = 2;
/// Number of pairs by which the planet's position was wrapped, positive in the direction of x of each mesh.
pub const WRAPPED: [i64; 2] = [3, -3];

/// Position [q, x, w] and rates of the left and the right mesh, and number of pairs by which x was wrapped.
#[derive(Clone, Copy, Debug)]
pub struct At {
    pub position: [[f64; 3]; 2],
    pub rate: [[f64; 3]; 2],
    pub wrapped: [i64; 2],
}

impl At {
    fn state(&self) -> PlanetState {
        PlanetState { planet: PLANET, position: self.position, rate: self.rate, wrapped: self.wrapped }
    }
}

/// Number of readings of a mesh: forces conjugate to q, x, w, then thrust on planet and side gear, and tangential
/// force. Thrusts and tangential force are zero under plain kinds.
pub const READINGS: usize = 6;

/// Readings of each mesh, and its heat of contact and of friction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forces {
    pub readings: [[f64; READINGS]; 2],
    pub heat: [[f64; 2]; 2],
}

/// Derivatives of the readings of both meshes with respect to [q, x, w] left and right and to their rates, and the
/// energy.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slopes {
    pub by: [[[f64; 12]; READINGS]; 2],
    pub energy: f64,
}

/// Evaluator: a plain mesh, or a detailed mesh with one resultant or with loads over the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Face {
    Plain,
    Whole,
    Distributed,
}

/// Perfect teeth, or teeth with errors, one of which is broken: over a fraction of its face from the heel, a depth [m]
/// is missing.
#[derive(Clone, Copy, Debug)]
pub enum Teeth {
    Perfect,
    Made(ToothErrorSpec, [f64; 2]),
}

/// No broken tooth.
pub const SOUND: [f64; 2] = [0.0; 2];

/// A kind of contact. If side gears are displaced, they move along their axes.
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

/// Plain teeth under the law `line`.
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
    // damping so strong that flanks often separate
    let stepping = Damping::Step { coefficient: 1e7, per_full_depth: PER_FULL_DEPTH };
    let dampings = [UNDAMPED, STEP, RESTITUTION, stepping, Damping::HuntCrossley { lambda: 60.0 }];
    let spec = ToothErrorSpec::default();
    let teeth = [
        Teeth::Perfect,
        Teeth::Made(ToothErrorSpec { crowning: 2e-5, ..spec }, SOUND),
        Teeth::Made(ToothErrorSpec { crowning: 2e-4, side_axial_offset: 2e-5, ..spec }, SOUND),
        Teeth::Made(ToothErrorSpec { shaft_angle_error: 5e-4, axis_offset: -2e-5, ..spec }, SOUND),
        Teeth::Made(ToothErrorSpec { accuracy_grade: 8, runout_by_grade: true, seed: 3, ..spec }, [0.5, 1e-3]),
        Teeth::Made(spec, [0.5, 1e-3]),
        Teeth::Made(spec, [0.5, 4e-6]),
        Teeth::Made(every_kind(), SOUND),
        // excess material that is uniform over the face
        Teeth::Made(ToothErrorSpec { side_axial_offset: -2e-4, ..spec }, SOUND),
    ];
    let mut kinds = Vec::new();
    for law in [Kind::Impact, Kind::Line, Kind::LineWeber, Kind::Lumped] {
        let is_of_teeth = OF_TEETH.contains(&law);
        for is_elastic in [false, true].into_iter().filter(|is_elastic| is_of_teeth || !is_elastic) {
            let plain = Contact { law, is_elastic, ..PLAIN };
            kinds.extend(dampings.map(|damping| Contact { damping, ..plain }));
            for (damping, friction) in dissipation {
                let whole = Contact { damping, friction, face: Face::Whole, ..plain };
                kinds.push(whole);
                let face = if is_of_teeth { Face::Distributed } else { Face::Whole };
                for is_displaced in [false, true] {
                    kinds.extend(teeth.map(|teeth| Contact { face, teeth, is_displaced, ..whole }));
                }
            }
        }
        kinds.push(Contact { law, has_corners: false, ..PLAIN });
    }
    kinds
}

/// A pair of gears with the exponent of IMPACT, with stiff and with elastic bodies, without and with contact of tip
/// corners.
pub struct Gears {
    pub pair: Pair,
    pub exponent: f64,
    teeth: FlankGaps,
    pub stiffness: [PairStiffness; 2],
    pub on_bodies: MeshOnBodies,
    pub couplings: Arc<PairCouplings>,
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
    /// Returns gears with `teeth`, `bores` [m] and `backlash` [m].
    pub fn new([planet_teeth, side_teeth]: [i32; 2], bores: [f64; 2], exponent: f64, backlash: f64) -> Arc<Self> {
        let pair = Pair::new(&GearSpec { planet_teeth, side_teeth, backlash, ..GearSpec::default() });
        let sections = PairStiffness::teeth(&pair, &RootSpec::default(), STEEL).unwrap();
        let supports = [Support::FreeBore(bores[0]), Support::Bore(bores[1])];
        let on_bodies = MeshOnBodies::new(&pair, &sections, supports, PLANETS as u32).unwrap();
        let elastic = PairStiffness::of_gears(&pair, &sections, LINE_LOAD, |i, roll| on_bodies.gear(i, roll)).unwrap();
        let stiff = PairStiffness::new(&pair, &RootSpec::default(), STEEL.young, STEEL.poisson, LINE_LOAD).unwrap();
        let phase = (pair.centred_position(), pair.base_pitch);
        let couplings = Arc::new(PairCouplings::new(&on_bodies, [elastic.path, elastic.range], phase));
        let engagements = [false, true].map(|corners| Engagement::new(&pair, corners, 0.05));
        let teeth = FlankGaps::perfect(&pair, PLANETS as i32);
        Arc::new(Self { pair, exponent, teeth, stiffness: [stiff, elastic], on_bodies, couplings, engagements })
    }

    /// Number of the planet tooth whose position in the right mesh corresponds to the position of tooth 0 in the left
    /// mesh.
    pub fn opposite(&self) -> i64 {
        self.teeth.opposite(PLANET)
    }

    fn gaps(&self, teeth: &Teeth) -> Option<Arc<FlankGaps>> {
        let Teeth::Made(spec, [missing_fraction, depth]) = *teeth else { return None };
        let errors = ToothErrors::new(&spec, &self.pair, PLANETS).unwrap();
        let (gear, index, tooth) = (FaultyGear::Planet, PLANET as i32, self.pair.gears[0].teeth - WRAPPED[0] as i32);
        let fault = ToothFaultSpec { gear, index, tooth, missing_fraction, depth, ..Default::default() };
        let mut gaps = self.teeth.clone();
        gaps.chip = Chip::new(&fault, &self.pair, PLANETS).unwrap().filter(|_| depth > 0.0);
        (gaps.least, gaps.errors) = (-errors.max_excess(self.pair.outer_cone), Some(errors));
        Some(Arc::new(gaps))
    }
}

/// A planet that meshes with both side gears, under one kind of contact.
pub struct Planet {
    pub contact: Contact,
    pub gears: Arc<Gears>,
    pub constants: planet::Contact,
}

/// Evaluates an expression with `contact` bound to the evaluator of a planet.
macro_rules! evaluate {
    ($of:expr, $contact:ident => $body:expr) => {
        match $of.constants.now(false, None, true) {
            AnyContact::Plain($contact) => $body,
            AnyContact::Solid($contact) => $body,
            AnyContact::InDetail($contact) => $body,
            AnyContact::OnBodies($contact) => $body,
        }
    };
}

fn forces<L: MeshLoad>(loads: &[L; 2]) -> Forces {
    let readings = loads.each_ref().map(|load| {
        let ([q, x, w], Pressing { planet_axial, side_axial, tangential }) = (load.force(), load.pressing());
        [q, x, w, planet_axial, side_axial, tangential]
    });
    Forces { readings, heat: loads.each_ref().map(L::heat) }
}

fn written<C: PlanetContact>(contact: &C, at: &PlanetState) -> Forces {
    let mut loads = [C::Load::none(); 2];
    contact.write(at, &mut loads);
    forces(&loads)
}

fn linearised<C: PlanetContact>(contact: &C, at: &PlanetState) -> (Forces, Slopes) {
    let mut loads = [C::Linearised::none(); 2];
    contact.linearise(at, &mut loads);
    let mut slopes = Slopes { energy: loads.iter().map(C::Linearised::energy).sum(), ..Slopes::default() };
    for (side, load) in loads.iter().enumerate() {
        // derivatives with respect to q, x, w, to their rates, and to q, x, w of the other mesh
        let blocks = [load.by_position(), load.by_rate(), load.by_other()];
        let [q, x, w] = [0, 1, 2].map(|row| std::array::from_fn(|i| blocks[i / 3][row][i % 3]));
        let pressing = load.pressing_slopes();
        assert!(pressing.force == if C::Linearised::PRESSES { q } else { [0.0; 9] });
        let rows = [q, x, w, pressing.planet_axial, pressing.side_axial, pressing.tangential];
        for (by, row) in slopes.by[side].iter_mut().zip(rows) {
            for (block, to) in row.chunks(3).zip([3 * side, 6 + 3 * side, 3 - 3 * side]) {
                by[to..][..3].copy_from_slice(block);
            }
        }
    }
    (forces(&loads), slopes)
}

impl Planet {
    pub fn new(contact: Contact, gears: &Arc<Gears>) -> Self {
        let (pair, stiffness) = (&gears.pair, &gears.stiffness[usize::from(contact.is_elastic)]);
        let Built { spring, whole, face, distributed } = Built::of(pair, stiffness, contact.law, gears.exponent);
        let (damping, is_single) = (contact.damping, contact.law == Kind::Lumped);
        let engagement = gears.engagements[usize::from(contact.has_corners)].clone();
        let mesh = Mesh { spring, damping, whole, is_single, engagement };
        let face = if contact.face == Face::Distributed { distributed.unwrap() } else { face };
        let friction = contact.friction.map(|spec| ToothFriction { spec, modulus: 0.5 * STEEL.plane_modulus() });
        let mut detailed = Detailed::new(pair, mesh.spring.clone(), damping, face, is_single, friction);
        detailed.has_seats = contact.is_displaced;
        if let Some(face) = distributed {
            detailed.set_friction_face(face);
        }
        let constants = planet::Contact {
            mesh,
            solid: None,
            bodies: contact.is_elastic.then(|| gears.couplings.clone()),
            detailed,
            gaps: [gears.gaps(&contact.teeth), None],
            perfect: gears.teeth.clone(),
            in_detail: contact.face != Face::Plain,
        };
        Self { contact, gears: gears.clone(), constants }
    }

    /// Cone distance at which the resultant of a pair acts [m].
    pub fn cone(&self) -> f64 {
        self.constants.mesh.whole.cone
    }

    pub fn forces(&self, at: &At) -> Forces {
        evaluate!(self, contact => written(&contact, &at.state()))
    }

    pub fn linearised(&self, at: &At) -> (Forces, Slopes) {
        evaluate!(self, contact => linearised(&contact, &at.state()))
    }

    pub fn energy(&self, at: &At) -> f64 {
        evaluate!(self, contact => contact.energy(&at.state()))
    }

    pub fn energy_gained(&self, from: &At, to: &At) -> f64 {
        evaluate!(self, contact => contact.energy_gained(&from.state(), &to.state()))
    }

    /// Calls `see` with each loaded pair, and with each loaded point of its face if loads differ over it.
    pub fn loaded(&self, at: &At, mut see: impl FnMut(&ToothLoad, Option<&SliceLoad>)) {
        let visit = Visit { sides: 0..2, directions: Some(&self.gears.pair) };
        evaluate!(self, contact => contact.visit(&at.state(), &visit, &mut see));
    }

    /// Sum of the normal forces of the `wanted` loads.
    pub fn normal(&self, at: &At, wanted: impl Fn(&ToothLoad) -> bool) -> f64 {
        let mut sum = 0.0;
        self.loaded(at, |load, _| sum += if wanted(load) { load.normal } else { 0.0 });
        sum
    }

    /// Cone distance of a point of a face, unless it moves with the loaded part. The flags are true if the two ends of
    /// the face, and the edge of a broken tooth on both sides, are loaded.
    pub fn fixed(&self, load: &ToothLoad, slice: Option<&SliceLoad>) -> (Option<f64>, [bool; 4]) {
        let Some(slice) = slice else { return (Some(load.cone), [true; 4]) };
        let face = &self.constants.detailed.face;
        let is_fixed = |cone: f64| cone == self.cone() || face.nodes().iter().any(|n| n.cone == cone);
        let [inner, outer] = face.ends().unwrap_or([self.cone(); 2]);
        let (edge, depth) = slice.opening.edge.unwrap_or((outer, 0.0));
        let ends = [(inner, 0.0), (outer, 0.0), (edge, 0.0), (edge, depth)];
        let is_loaded = |(end, missing)| slice.approach.arc - (slice.opening.at(end) + missing) / end > 0.0;
        (Some(load.cone).filter(|cone| is_fixed(*cone)), ends.map(is_loaded))
    }

    /// Touching pairs of perfect teeth of the mesh `side`.
    pub fn pairs(&self, at: &At, side: usize) -> Vec<ToothPair> {
        let [q, x, _] = at.position[side];
        self.constants.mesh.engagement.pairs([q, x]).collect()
    }

    /// Opening of the flanks of a pair of the left mesh.
    pub fn opening(&self, ToothPair { flank, number, s, .. }: &ToothPair) -> Opening {
        let tooth = if *flank == Flank::Drive { number - WRAPPED[0] } else { -(number + WRAPPED[0]) };
        let name = PairName { planet: PLANET, side: 0, flank: *flank, tooth };
        self.constants.gaps(false).map_or(Opening::NONE, |gaps| gaps.opening(&name, *s))
    }

    /// Elastic torque per ∫R² dR of teeth at the arc `arc` and the position `s` [rad].
    pub fn torque(&self, arc: f64, s: f64) -> f64 {
        self.constants.mesh.spring.at(arc, s).torque
    }
}

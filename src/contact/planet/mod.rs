//! Contact of one planet with both side gears. It is the unit of contact, because the planet's body couples its two
//! meshes.
//!
//! Every kind of contact implements [`PlanetContact`]: forces, derivatives, energy, kinks, and a visitor over loads.
//! The equations of motion use only this trait. The coordinates of a mesh are q, x and the displacement of its side
//! gear (`Q`, `X`, `W`). A kind of contact in which gears stay on their axes has no force along w.

mod in_detail;
mod load;
mod plain;
mod solid;

use std::ops::Range;
use std::sync::Arc;

pub use in_detail::InDetail;
pub use load::{LinearisedLoad, MeshLoad, Pressing, PressingSlopes};
pub use plain::Plain;
pub use solid::Solid;

use super::bodies::PairCouplings;
use super::detailed::{Detailed, DetailedState, LOCAL, PairName, SliceLoad, WITH_OTHER};
use super::mesh::{Mesh, MeshState};
use super::solid::mesh::SolidMesh;
use super::{Damping, Flank, FlankGaps, ToothFriction, ToothLoad};
use crate::FULL;
use crate::geometry::Pair;

/// Relative position of planet and side gear [rad].
pub const Q: usize = 0;
/// Travel of the planet [rad].
pub const X: usize = 1;
/// Displacement of the side gear along its axis, away from the apex [m].
pub const W: usize = 2;
/// Coordinates of a mesh.
pub const COORDINATES: usize = 3;

/// State of the two meshes of a planet.
#[derive(Clone, Copy, Debug)]
pub struct PlanetState {
    /// Planet.
    pub planet: usize,
    /// Coordinates of both meshes, left and right.
    pub position: [[f64; COORDINATES]; 2],
    /// Rates of the coordinates.
    pub rate: [[f64; COORDINATES]; 2],
    /// Number of pairs by which the planet's position was wrapped, positive in the direction of x of each mesh.
    pub wrapped: [i64; 2],
}

impl PlanetState {
    /// State of the mesh of side `s`, without the displacement of its side gear.
    #[inline(always)]
    pub fn mesh(&self, s: usize) -> MeshState {
        let [[q, x, _], [dq, dx, _]] = [self.position[s], self.rate[s]];
        MeshState { position: [q, x], rate: [dq, dx], which: [self.planet, s] }
    }

    /// State of the mesh of side `s`.
    #[inline(always)]
    pub fn detailed(&self, s: usize) -> DetailedState {
        DetailedState { position: self.position[s], rate: self.rate[s], wrapped: self.wrapped[s] }
    }

    /// Name of pair `number` of `flank` on side `s`.
    fn name(&self, s: usize, flank: Flank, number: i64) -> PairName {
        PairName::new((self.planet, s), flank, number, self.wrapped[s])
    }
}

/// Selection of the loads to visit, and of the optional data to compute.
#[derive(Clone, Debug)]
pub struct Visit<'a> {
    /// Sides, 0 left and 1 right.
    pub sides: Range<usize>,
    /// Geometry from which the directions of normals are computed. Without it, directions that need extra work are
    /// zero.
    pub directions: Option<&'a Pair>,
}

/// Callback for each load. If loads differ over the face, it also receives the slice of the face.
pub type Visitor<'a> = dyn FnMut(&ToothLoad, Option<&SliceLoad>) + 'a;

/// Contact of one planet with both side gears.
pub trait PlanetContact {
    /// Load of a mesh.
    type Load: MeshLoad;
    /// Load of a mesh with its derivatives.
    type Linearised: LinearisedLoad;

    /// Writes the loads of both meshes in place.
    fn write(&self, at: &PlanetState, to: &mut [Self::Load; 2]);

    /// Writes the loads of both meshes with their exact derivatives.
    fn linearise(&self, at: &PlanetState, to: &mut [Self::Linearised; 2]);

    /// Elastic energies of both meshes [J].
    fn energies(&self, at: &PlanetState) -> [f64; 2];

    /// Elastic energy of both meshes [J].
    fn energy(&self, at: &PlanetState) -> f64 {
        let [left, right] = self.energies(at);
        left + right
    }

    /// Elastic energy gained between two states [J]. Sums the differences mesh by mesh, so that a mesh that does not
    /// move gains exactly nothing.
    fn energy_gained(&self, from: &PlanetState, to: &PlanetState) -> f64 {
        let (from, to) = (self.energies(from), self.energies(to));
        (to[0] - from[0]) + (to[1] - from[1])
    }

    /// Fraction of a step of `h` [s] at which a force has its first kink, predicted from the state `at`. `None` if no
    /// kink is predicted.
    fn kink(&self, at: &PlanetState, h: f64) -> Option<f64>;

    /// Calls `see` with each loaded tooth pair, or with each loaded slice of it.
    fn visit(&self, at: &PlanetState, visit: &Visit, see: &mut Visitor);

    /// K_Hβ of the pair with the loaded slice `slice`. It is 1 if a law has one resultant for the whole face.
    fn face_load_factor(&self, _at: &PlanetState, _slice: &ToothLoad, _pair: &Pair) -> f64 {
        1.0
    }
}

/// The smaller of two optional fractions of a step.
#[inline(always)]
fn first(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

/// Contact of any kind.
#[derive(Clone, Copy)]
pub enum AnyContact<'a> {
    /// Flanks that fit, rigid bodies.
    Plain(Plain<'a>),
    /// Solid teeth.
    Solid(Solid<'a>),
    /// Sums over the face, rigid bodies.
    InDetail(InDetail<'a, LOCAL>),
    /// Sums over the face, elastic bodies.
    OnBodies(InDetail<'a, WITH_OTHER>),
}

/// Evaluates an expression with `contact` bound to the contact in use. Without effects (`MAY_ACT` false), only flanks
/// that fit and solid teeth are compiled.
macro_rules! with_contact {
    ($may_act:expr, $of:expr, $contact:ident => $body:expr) => {
        match $of {
            $crate::contact::planet::AnyContact::Plain($contact) => $body,
            $crate::contact::planet::AnyContact::Solid($contact) => $body,
            $crate::contact::planet::AnyContact::InDetail($contact) if $may_act => $body,
            $crate::contact::planet::AnyContact::OnBodies($contact) if $may_act => $body,
            // [`Contact::without_effects`] returns none of these
            _ => unreachable!(),
        }
    };
}
pub(crate) use with_contact;

/// Constants of the contact, identical for all planets and both sides.
#[derive(Clone, Debug)]
pub struct Contact {
    /// The mesh of flanks that fit.
    pub mesh: Mesh,
    /// Solid teeth.
    pub solid: Option<Box<SolidMesh>>,
    /// Elastic bodies that couple tooth pairs.
    pub bodies: Option<Arc<PairCouplings>>,
    /// The detailed mesh, summed over the face.
    pub detailed: Detailed,
    /// Gaps of the tooth pairs before and after a tooth breaks.
    pub gaps: [Option<Arc<FlankGaps>>; 2],
    /// Teeth without errors, used to number the teeth.
    pub perfect: FlankGaps,
    /// True if an effect needs sums over the face even while no tooth is broken.
    pub in_detail: bool,
}

/// Work of a section of solid teeth per facet of a flank, relative to a mesh of plain teeth.
const SOLID_PER_FACET: usize = 2;
/// Minimum work of a section of solid teeth, relative to a mesh of plain teeth.
const MIN_SOLID: usize = 40;
/// Maximum work of a planet's meshes on elastic gear bodies, relative to a mesh of plain teeth. A dozen pairs then move
/// each other.
const ON_BODIES: usize = 16;

impl Contact {
    /// Returns the present contact. `viscosity` is the viscosity of the oil [Pa·s], if friction depends on it. If
    /// `is_part_of_steps`, forces of plain teeth are inlined into the caller.
    #[inline]
    pub fn now(&self, is_tooth_broken: bool, viscosity: Option<f64>, is_part_of_steps: bool) -> AnyContact<'_> {
        let (contact, gaps) = (self, self.gaps(is_tooth_broken));
        match self.bodies.as_deref() {
            Some(bodies) => AnyContact::OnBodies(InDetail { contact, gaps, viscosity, bodies: Some(bodies) }),
            None if self.in_detail || is_tooth_broken => {
                AnyContact::InDetail(InDetail { contact, gaps, viscosity, bodies: None })
            }
            None => self.without_effects(is_part_of_steps),
        }
    }

    /// Returns the contact without any effects. If `is_part_of_steps`, forces of plain teeth are inlined into the
    /// caller.
    #[inline]
    pub fn without_effects(&self, is_part_of_steps: bool) -> AnyContact<'_> {
        match &self.solid {
            Some(solid) if FULL => AnyContact::Solid(Solid { contact: self, solid }),
            _ => AnyContact::Plain(Plain { contact: self, is_part_of_steps }),
        }
    }

    /// Replaces the damping.
    pub fn set_damping(&mut self, damping: Damping) {
        self.mesh.damping = damping;
        self.detailed.set_damping(damping);
        if let Some(solid) = &mut self.solid {
            solid.damping = damping;
        }
    }

    /// Gaps of the teeth.
    pub fn gaps(&self, is_tooth_broken: bool) -> Option<&FlankGaps> {
        self.gaps[usize::from(is_tooth_broken)].as_deref()
    }

    /// Friction along the flanks. `viscosity` is the viscosity of the oil [Pa·s], if friction depends on its
    /// temperature.
    pub fn friction(&self, viscosity: Option<f64>) -> Option<ToothFriction> {
        let friction = self.detailed.friction?;
        Some(viscosity.map_or(friction, |viscosity| friction.with_viscosity(viscosity)))
    }

    /// Work of all meshes of `groups` planets relative to a plain mesh, at least 1. `facets` is the number of facets of
    /// a solid flank.
    pub fn work(&self, facets: usize, groups: usize) -> usize {
        // with few facets, each has many neighbours; with many facets, their number dominates
        if let Some(solid) = &self.solid {
            return solid.section_count() * (SOLID_PER_FACET * facets).max(MIN_SOLID);
        }
        let in_detail = if self.in_detail { self.detailed.face.points() } else { 0 };
        let on_bodies = if self.bodies.is_some() { ON_BODIES } else { 0 };
        ((in_detail + on_bodies) * groups).max(1)
    }
}

//! Flanks that fit, on elastic gear bodies: the pairs of both meshes move each other.

use super::load::{Block, LinearisedForce, LinearisedLoad, MeshLoad, without_displacement};
use super::{COORDINATES, Contact, PlanetContact, PlanetState, Visit, Visitor, first, plain};
use crate::contact::AnySpring;
use crate::contact::bodies::PairCouplings;
use crate::contact::mesh::{MeshForce, MeshJacobian};
use crate::contact::shared::{OpeningByOthers, SharedForce, SharedMeshes};
use crate::contact::spring::with_teeth;

/// A planet with elastic gear bodies.
#[derive(Clone, Copy)]
pub struct OnBodies<'a> {
    /// Constants.
    pub contact: &'a Contact,
    /// Couplings through the bodies.
    pub bodies: &'a PairCouplings,
}

/// Load of a mesh with its derivatives, including those with respect to the planet's other mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct CoupledForce {
    own: LinearisedForce,
    by_other: [[f64; 2]; 2],
}

impl MeshLoad for CoupledForce {
    const PRESSES: bool = false;
    fn none() -> Self {
        Self::default()
    }
    fn force(&self) -> [f64; COORDINATES] {
        self.own.force()
    }
    fn heat(&self) -> [f64; 2] {
        self.own.heat()
    }
}

impl LinearisedLoad for CoupledForce {
    const COUPLED: bool = true;
    fn energy(&self) -> f64 {
        self.own.energy()
    }
    fn by_position(&self) -> Block {
        self.own.by_position()
    }
    fn by_rate(&self) -> Block {
        self.own.by_rate()
    }
    fn by_other(&self) -> Block {
        without_displacement(&self.by_other)
    }
}

impl OnBodies<'_> {
    fn spring(&self) -> &AnySpring {
        &self.contact.mesh.spring
    }

    fn meshes(&self, at: &PlanetState) -> SharedMeshes<'_> {
        let Contact { mesh, perfect, .. } = self.contact;
        SharedMeshes { mesh, bodies: self.bodies, opposite: perfect.opposite(at.planet), wrapped: at.wrapped }
    }
}

impl PlanetContact for OnBodies<'_> {
    type Load = MeshForce;
    type Linearised = CoupledForce;

    #[inline(never)]
    fn write(&self, at: &PlanetState, to: &mut [MeshForce; 2]) {
        let states = &[at.mesh(0), at.mesh(1)];
        *to = with_teeth!(self.spring(), spring => self.meshes(at).force(spring, states), Default::default());
    }

    #[inline(never)]
    fn linearise(&self, at: &PlanetState, to: &mut [CoupledForce; 2]) {
        let states = &[at.mesh(0), at.mesh(1)];
        let both =
            with_teeth!(self.spring(), spring => self.meshes(at).linearise(spring, states), SharedForce::default());
        for s in 0..2 {
            // the energy belongs to both meshes together and is counted once
            let energy = if s == 0 { both.energy } else { 0.0 };
            let by = MeshJacobian { by_position: both.by_position[s][s], by_rate: both.by_rate[s], energy };
            let own = LinearisedForce { force: both.force[s], by };
            to[s] = CoupledForce { own, by_other: both.by_position[s][1 - s] };
        }
    }

    fn energy(&self, at: &PlanetState) -> f64 {
        with_teeth!(self.spring(), spring => self.meshes(at).energy(spring, &[at.mesh(0), at.mesh(1)]), 0.0)
    }

    #[inline(never)]
    fn kink(&self, at: &PlanetState, h: f64) -> Option<f64> {
        let states = [at.mesh(0), at.mesh(1)];
        let openings = with_teeth!(
            self.spring(),
            spring => self.meshes(at).opening_by_others(spring, &states),
            OpeningByOthers::default()
        );
        let kink =
            |s: usize| self.contact.mesh.kink_of_open(&states[s], h, |flank, number, _| openings.of(s, flank, number));
        first(kink(0), kink(1))
    }

    fn visit(&self, at: &PlanetState, visit: &Visit, see: &mut Visitor) {
        let states = &[at.mesh(0), at.mesh(1)];
        for s in visit.sides.clone() {
            let mut see = |pair: &_, force: &_| see(&plain::load(self.contact, (at, s), (pair, force), visit), None);
            with_teeth!(self.spring(), spring => self.meshes(at).loaded(spring, states, s, &mut see), ());
        }
    }
}

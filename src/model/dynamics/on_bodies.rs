//! Meshes of gears with elastic bodies: both meshes of a planet at once, since its body couples them.

use super::Equations;
use super::in_detail::Local;
use super::ledger_rates::LedgerRates;
use crate::contact::bodies::PairCouplings;
use crate::contact::detailed::{DetailedLoad, PairName, SharedTeeth};
use crate::contact::impact::Force;
use crate::contact::mesh::{MeshForce, MeshState};
use crate::contact::shared::{OpeningByOthers, SharedForce, SharedMeshes};
use crate::contact::{Flank, Law, ToothPair};
use crate::integrate::{Matrix, Point};
use crate::model::setup::CONTACT_HEAT;

/// Evaluates an expression with `law` bound to the law of teeth in use; bodies are elastic under no other.
macro_rules! with_teeth {
    ($of:expr, $law:ident => $body:expr, $none:expr) => {
        match $of {
            Law::Line($law) => $body,
            Law::LineWeber($law) => $body,
            _ => $none,
        }
    };
}

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    /// The bodies that pairs share, where they are elastic.
    #[inline]
    pub(in crate::model) fn bodies_of_gears(&self) -> Option<&PairCouplings> {
        // a constant where no effect acts, so that plain scenes do not even ask
        if WITH_EFFECTS { self.teeth.shared.as_deref() } else { None }
    }

    /// Number of the tooth of the unrolled sequence of the pair `number` of `flank`.
    #[inline]
    pub(super) fn pair_name(&self, g: usize, s: usize, flank: Flank, number: i64) -> PairName {
        let wrapped = self.wrapped(g, s);
        let tooth = if flank == Flank::Drive {
            number.wrapping_sub(wrapped)
        } else {
            number.wrapping_add(wrapped).wrapping_neg()
        };
        PairName { planet: self.teeth.plan.group(g).planet, side: s, flank, tooth }
    }

    /// States of both meshes of group `g`.
    #[inline]
    pub(super) fn mesh_states(&self, at: &Point<N>, g: usize) -> [MeshState; 2] {
        [0, 1].map(|s| self.mesh_state(at, g, s))
    }

    #[inline]
    fn meshes<'b>(&'b self, bodies: &'b PairCouplings, g: usize) -> SharedMeshes<'b> {
        let opposite = self.teeth.effect_terms.perfect.opposite(self.teeth.plan.group(g).planet);
        SharedMeshes { mesh: &self.teeth.mesh, bodies, opposite, wrapped: [0, 1].map(|s| self.wrapped(g, s)) }
    }

    /// Forces of both plain meshes of group `g` on `bodies`, with derivatives and energy.
    #[inline]
    pub(super) fn linearised_on_bodies(
        &self,
        bodies: &PairCouplings,
        states: &[MeshState; 2],
        g: usize,
    ) -> SharedForce {
        with_teeth!(&self.teeth.mesh.law, law => self.meshes(bodies, g).linearise(law, states), SharedForce::default())
    }

    /// Forces of both plain meshes of group `g` on `bodies`.
    #[inline]
    pub(super) fn forces_on_bodies(&self, bodies: &PairCouplings, at: &Point<N>, g: usize) -> [MeshForce; 2] {
        let states = &self.mesh_states(at, g);
        with_teeth!(&self.teeth.mesh.law, law => self.meshes(bodies, g).force(law, states), Default::default())
    }

    /// Elastic energy of both meshes of group `g`, plain or in detail [J].
    pub(in crate::model) fn planet_energy(&self, at: &Point<N>, g: usize) -> f64 {
        match self.bodies_of_gears() {
            None => self.mesh_energy(at, g, 0) + self.mesh_energy(at, g, 1),
            Some(bodies) => self.energy_on_bodies(bodies, [at, at], g),
        }
    }

    /// The same on `bodies`, with the left mesh at one point and the right mesh at another.
    #[inline]
    pub(super) fn energy_on_bodies(&self, bodies: &PairCouplings, at: [&Point<N>; 2], g: usize) -> f64 {
        if WITH_EFFECTS && self.in_detail() {
            let states = [0, 1].map(|s| self.detailed_state(at[s], g, s));
            return self.teeth.effect_terms.detailed.energy_shared(&self.shared_teeth(bodies, g), &states);
        }
        let states = [0, 1].map(|s| self.mesh_state(at[s], g, s));
        with_teeth!(&self.teeth.mesh.law, law => self.meshes(bodies, g).energy(law, &states), 0.0)
    }

    /// Elastic energy that the pairs of the mesh of group `g` with side `s` bring along which come or go between two points
    /// [J]. Those of both sides may do so at once.
    pub(in crate::model) fn energy_brought(&self, [before, after]: [&Point<N>; 2], g: usize, s: usize) -> f64 {
        let Some(bodies) = self.bodies_of_gears() else {
            return self.mesh_energy(after, g, s) - self.mesh_energy(before, g, s);
        };
        let [from, to] = if s == 0 { [[before, before], [after, before]] } else { [[after, before], [after, after]] };
        self.energy_on_bodies(bodies, to, g) - self.energy_on_bodies(bodies, from, g)
    }

    /// Calls `visit` with each loaded pair of the plain mesh of group `g` with side `s`, and its force.
    pub(super) fn loaded_pairs(&self, at: &Point<N>, g: usize, s: usize, mut visit: impl FnMut(&ToothPair, &Force)) {
        match self.bodies_of_gears() {
            None => self.teeth.mesh.loaded(&self.mesh_state(at, g, s), visit),
            Some(bodies) => {
                let states = self.mesh_states(at, g);
                with_teeth!(&self.teeth.mesh.law, law => self.meshes(bodies, g).loaded(law, &states, s, &mut visit), ());
            }
        }
    }

    /// By how much pairs of group `g` are moved by others.
    pub(super) fn opening_by_others(&self, bodies: &PairCouplings, at: &Point<N>, g: usize) -> OpeningByOthers {
        if self.in_detail() {
            let states = &self.detailed_states(at, g);
            return self.teeth.effect_terms.detailed.opening_by_others(&self.shared_teeth(bodies, g), states);
        }
        let states = self.mesh_states(at, g);
        with_teeth!(&self.teeth.mesh.law, law => self.meshes(bodies, g).opening_by_others(law, &states), OpeningByOthers::default())
    }

    /// Teeth of both meshes of group `g` on `bodies`.
    pub(super) fn shared_teeth<'b>(&'b self, bodies: &'b PairCouplings, g: usize) -> SharedTeeth<'b> {
        let opposite = self.teeth.effect_terms.perfect.opposite(self.teeth.plan.group(g).planet);
        SharedTeeth { teeth: [0, 1].map(|s| self.mesh_teeth(g, s)), bodies, opposite }
    }

    /// Writes the loads of both meshes of group `g` in detail to where they stay.
    #[inline]
    pub(super) fn write_planet_loads<T: Local>(&self, at: &Point<N>, g: usize, loads: &mut [DetailedLoad<T>; 2]) {
        let mesh = &self.teeth.effect_terms.detailed;
        match self.bodies_of_gears() {
            Some(bodies) => *loads = T::load_shared(mesh, &self.shared_teeth(bodies, g), &self.detailed_states(at, g)),
            None => {
                for s in 0..2 {
                    loads[s] = T::load(mesh, &self.mesh_teeth(g, s), &self.detailed_state(at, g, s));
                }
            }
        }
    }

    /// Torques of the teeth of one planet of group `g` on both side gears, while nothing turns against anything else [N·m].
    pub(in crate::model) fn planet_torques(&self, at: &Point<N>, g: usize) -> [f64; 2] {
        let still = &Point { q: at.q, v: [0.0; N] };
        let side = self.teeth.sin_base[1];
        if WITH_EFFECTS && self.in_detail() {
            let mut loads = [DetailedLoad::<f64>::zero(); 2];
            self.write_planet_loads(still, g, &mut loads);
            return loads.map(|load| side * load.force[0]);
        }
        let force = match self.bodies_of_gears() {
            Some(bodies) => self.forces_on_bodies(bodies, still, g),
            None => {
                let mut force = [MeshForce::default(); 2];
                for s in 0..2 {
                    self.write_force(&self.mesh_state(still, g, s), &mut force[s]);
                }
                force
            }
        };
        force.map(|force| side * force.force[0])
    }

    /// Adds the forces of all plain meshes on `bodies`, and their derivatives by positions and rates; sets their heat. Returns
    /// their elastic energy [J].
    #[inline]
    pub(super) fn add_shared_forces(
        &self,
        bodies: &PairCouplings,
        at: &Point<N>,
        sum: &mut [f64; N],
        [by_position, by_rate]: [&mut Matrix<N>; 2],
        ledger_rates: &mut LedgerRates,
    ) -> f64 {
        let mut shared = [SharedForce::default(); G];
        for g in 0..self.groups() {
            shared[g] = match self.twin(at, g) {
                Some(twin) => shared[twin],
                None => self.linearised_on_bodies(bodies, &self.mesh_states(at, g), g),
            };
        }
        self.add_forces(|g, s| shared[g].force[s].force, sum);
        self.add_shared_blocks(&shared, by_position);
        let rates = self.by_group(|g| [0, 1].map(|s| self.block(s, &shared[g].by_rate[s])));
        self.add_blocks::<false>(&rates, by_rate);
        ledger_rates.heat[CONTACT_HEAT] =
            self.sum(|g| self.members(g) * (shared[g].force[0].heat + shared[g].force[1].heat));
        self.sum(|g| self.members(g) * shared[g].energy)
    }
}

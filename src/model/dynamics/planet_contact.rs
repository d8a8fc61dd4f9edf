//! Contact of the planets with both side gears, in the equations of motion. No other file of the equations depends on
//! the kinds of contact.

use super::dry_friction::MeshLoads;
use super::ledger_rates::LedgerRates;
use super::shape::{ByGroup, Shape};
use super::{Equations, FrictionEquations, Jacobian};
use crate::contact::planet::{
    AnyContact, LinearisedLoad, MeshLoad, PlanetContact, PlanetState, Q, Visit, Visitor, with_contact,
};
use crate::contact::{FlankGaps, ToothFriction, ToothLoad};
use crate::geometry::Pair;
use crate::integrate::{Matrix, Point};
use crate::model::assembly::Teeth;
use crate::model::dynamics::State;
use crate::model::effect_kinds::SurfaceLoad;
use crate::model::setup::CONTACT_HEAT;
use crate::numeric::{lanes, sqrt};

impl Teeth {
    /// True if the meshes are summed in detail in `state`: an effect needs it, or a tooth is broken.
    pub fn are_in_detail(&self, state: &State) -> bool {
        self.contact.in_detail || state.is_tooth_broken
    }

    /// True if the loads of the meshes are independent: no tooth pair deflects another one, and nothing is summed over
    /// the face.
    pub fn have_independent_meshes(&self, state: &State) -> bool {
        !self.are_in_detail(state) && self.contact.bodies.is_none() && !self.layout.has_pins
    }
}

impl<const N: usize, S: Shape<N>> Equations<'_, S, N> {
    /// Contact in its present condition: broken tooth and oil viscosity.
    #[inline]
    pub(super) fn contact(&self) -> AnyContact<'_> {
        if S::MAY_ACT {
            let viscosity = self.applied.oil_viscosity.map(|oil| oil.dynamic);
            self.teeth.contact.now(self.is_tooth_broken, viscosity, S::HAS_OWN_STEPS)
        } else {
            self.teeth.contact.without_effects(S::HAS_OWN_STEPS)
        }
    }

    /// Gaps of the tooth pairs with intact or broken teeth; `None` for perfect teeth.
    pub(in crate::model) fn gaps(&self) -> Option<&FlankGaps> {
        self.teeth.contact.gaps(self.is_tooth_broken)
    }

    /// True if teeth have gaps, or if gear bodies are elastic.
    pub(in crate::model) fn is_open_or_elastic(&self) -> bool {
        self.gaps().is_some() || self.teeth.contact.bodies.is_some()
    }

    /// Friction along the flanks at the present viscosity of the oil; `None` without tooth friction.
    pub(in crate::model) fn flank_friction(&self) -> Option<ToothFriction> {
        self.teeth.contact.friction(self.applied.oil_viscosity.map(|oil| oil.dynamic))
    }

    /// Returns an earlier group whose meshes have exactly the state of the meshes of group `g`, so that both have the
    /// same loads. Planets that are simulated individually move identically until an event, such as a broken tooth,
    /// makes one of them differ. Returns `None` if no earlier group has this state.
    #[inline]
    pub(in crate::model) fn twin(&self, at: &Point<N>, g: usize) -> Option<usize> {
        if self.groups() == 1 || self.teeth.contact.solid.is_some() {
            return None;
        }
        let same = |i: usize, j: usize| at.q[i] == at.q[j] && at.v[i] == at.v[j];
        (0..g).find(|&h| {
            self.teeth.plan.group(g).phase == self.teeth.plan.group(h).phase
                && self.offset[g] == self.offset[h]
                && same(self.planet(g), self.planet(h))
                && (!self.has_pins() || same(self.pin(g), self.pin(h)))
        })
    }

    /// Returns [`Self::twin`] of group `g` for loads of type `L`, but `None` for detailed loads, because the teeth of
    /// two planets may differ.
    #[inline(always)]
    fn twin_under<L: MeshLoad>(&self, at: &Point<N>, g: usize) -> Option<usize> {
        if L::PRESSES { None } else { self.twin(at, g) }
    }

    /// Adds the forces of all meshes to `sum`, which is zero, sets their heat, and adds the dry friction under them.
    /// Returns the torques of the meshes on the side gears.
    #[inline(never)]
    pub(in crate::model) fn add_mesh_forces(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) -> [f64; 2] {
        with_contact!(S::MAY_ACT, self.contact(), contact => {
            let loads = self.loads(at, |state, to| contact.write(state, to));
            if S::MAY_ACT {
                self.add_loads_and_friction(&loads, at, sum, ledger_rates)
            } else {
                self.add_loads(&loads, sum, ledger_rates);
                [sum[0], sum[1]]
            }
        })
    }

    /// Loads of both meshes of each planet group, computed by `write`.
    #[inline(always)]
    fn loads<L: MeshLoad>(&self, at: &Point<N>, write: impl Fn(&PlanetState, &mut [L; 2])) -> S::ByGroup<[L; 2]> {
        let mut loads = S::ByGroup::filled([L::none(); 2]);
        for g in 0..self.groups() {
            match self.twin_under::<L>(at, g) {
                Some(twin) => loads[g] = loads[twin],
                None => write(&self.planet_state(at, g), &mut loads[g]),
            }
        }
        loads
    }

    /// Adds the forces of `loads`, sets their heat, and adds the dry friction under them. Returns the torques of the
    /// meshes on the side gears. Not inlined, so that it is compiled once for each type of load.
    #[inline(never)]
    fn add_loads_and_friction<L: MeshLoad>(
        &self,
        loads: &S::ByGroup<[L; 2]>,
        at: &Point<N>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) -> [f64; 2] {
        self.add_loads(loads, sum, ledger_rates);
        let on_sides = [sum[0], sum[1]];
        let surfaces = (L::PRESSES && self.has_dry_friction()).then(|| self.mesh_surface_loads(at, loads));
        self.add_friction(at, surfaces.as_ref(), sum, ledger_rates);
        on_sides
    }

    /// Adds the forces of `loads` and sets their heat.
    #[inline(always)]
    fn add_loads<L: MeshLoad>(&self, loads: &S::ByGroup<[L; 2]>, sum: &mut [f64; N], ledger_rates: &mut LedgerRates) {
        let mut all = *sum;
        self.add_forces(|g, s| loads[g][s].force(), &mut all);
        lanes::write(all, sum);
        let heat = |i: usize| self.sum(|g| self.members(g) * (loads[g][0].heat()[i] + loads[g][1].heat()[i]));
        ledger_rates.heat[CONTACT_HEAT] = heat(0);
        let of_friction = self.teeth.effect_terms.friction_heat_index;
        if L::PRESSES && of_friction != CONTACT_HEAT {
            ledger_rates.heat[of_friction] = heat(1);
        }
    }

    /// Adds the forces of all meshes and the dry friction under them, both with their derivatives. Sets their heat.
    /// Returns the elastic energy of all meshes [J].
    #[inline]
    pub(super) fn linearise_contact(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
        j: &mut Jacobian<'_, N>,
    ) -> f64 {
        with_contact!(S::MAY_ACT, self.contact(), contact => {
            let loads = self.loads(at, |state, to| contact.linearise(state, to));
            if S::MAY_ACT {
                self.add_linearised_outlined(&loads, at, sum, ledger_rates, j)
            } else {
                self.add_linearised(&loads, at, sum, ledger_rates, j)
            }
        })
    }

    /// [`Self::add_linearised`], not inlined, so that it is compiled once for each type of load.
    #[inline(never)]
    fn add_linearised_outlined<L: LinearisedLoad>(
        &self,
        loads: &S::ByGroup<[L; 2]>,
        at: &Point<N>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
        j: &mut Jacobian<'_, N>,
    ) -> f64 {
        self.add_linearised(loads, at, sum, ledger_rates, j)
    }

    /// Adds the forces of `loads` and the dry friction under them, both with their derivatives. Sets their heat.
    /// Returns the elastic energy of all meshes [J].
    #[inline(always)]
    fn add_linearised<L: LinearisedLoad>(
        &self,
        loads: &S::ByGroup<[L; 2]>,
        at: &Point<N>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
        j: &mut Jacobian<'_, N>,
    ) -> f64 {
        self.add_loads(loads, sum, ledger_rates);
        self.add_block::<false>(|g, s| loads[g][s].by_position(), j.by_position);
        self.add_block::<false>(|g, s| loads[g][s].by_rate(), j.by_rate);
        if L::COUPLED {
            self.add_block::<true>(|g, s| loads[g][s].by_other(), j.by_position);
        }
        let surfaces = (L::PRESSES && self.has_dry_friction()).then(|| self.mesh_surface_loads(at, loads));
        self.add_friction(at, surfaces.as_ref(), sum, ledger_rates);
        if let Some(surfaces) = &surfaces {
            self.friction_slopes_by_loads(at, loads, surfaces, j);
            self.friction_slopes_by_orbit(at, &surfaces.1, j);
        }
        self.friction_slopes_under(at, surfaces.as_ref(), j);
        self.sum(|g| self.members(g) * (loads[g][0].energy() + loads[g][1].energy()))
    }

    /// Adds the forces of the meshes at rest, with their derivatives with respect to positions.
    pub(super) fn static_contact(&self, at: &Point<N>, sum: &mut [f64; N], by_position: &mut Matrix<N>) {
        let still = &Point { q: at.q, v: [0.0; N] };
        with_contact!(S::MAY_ACT, self.contact(), contact => {
            let loads = self.loads(still, |state, to| contact.linearise(state, to));
            self.add_loads(&loads, sum, &mut LedgerRates::default());
            self.add_block::<false>(|g, s| loads[g][s].by_position(), by_position);
            self.add_block::<true>(|g, s| loads[g][s].by_other(), by_position);
        });
    }

    /// Torque of plain teeth on the gear of side `s` at rest, and its derivative with respect to the angle of the gear.
    pub(in crate::model) fn torque_of_plain_teeth(&self, s: usize, at: &Point<N>) -> [f64; 2] {
        let still = &Point { q: at.q, v: [0.0; N] };
        let arm = self.teeth.sin_base[1];
        with_contact!(false, self.teeth.contact.without_effects(false), contact => {
            let loads = self.loads(still, |state, to| contact.linearise(state, to));
            let force = self.sum(|g| self.members(g) * arm * loads[g][s].force()[Q]);
            [force, self.sum(|g| self.members(g) * arm * arm * loads[g][s].by_position()[Q][Q])]
        })
    }

    /// Loads on the rubbing surfaces of side gears and planets, from the loads of all meshes and the planets' orbit.
    #[inline]
    fn mesh_surface_loads<L: MeshLoad>(&self, at: &Point<N>, loads: &S::ByGroup<[L; 2]>) -> MeshLoads<S, N> {
        let side = self.teeth.sin_base[1];
        let torques = [0, 1].map(|s| self.sum(|g| self.members(g) * side * loads[g][s].force()[Q]));
        let pressing = self.applied.friction().ramps.loads(torques);
        let sides = [0, 1].map(|s| SurfaceLoad {
            thrust: self.sum(|g| self.members(g) * loads[g][s].pressing().side_axial),
            load: pressing[s],
        });
        let mut planets = S::ByGroup::filled(SurfaceLoad::default());
        for g in 0..self.groups() {
            let [l, r] = [loads[g][0].pressing(), loads[g][1].pressing()];
            let across = l.tangential + r.tangential;
            let along = l.side_axial - r.side_axial;
            planets[g] = SurfaceLoad {
                thrust: l.planet_axial + r.planet_axial + self.centrifugal(at, g)[0],
                load: sqrt(across * across + along * along),
            };
        }
        (sides, planets)
    }

    /// Loads on the rubbing surfaces of side gears and planets, or `None` if mesh loads are not detailed.
    pub(super) fn surfaces_pressed(&self, at: &Point<N>) -> Option<MeshLoads<S, N>> {
        with_contact!(S::MAY_ACT, self.contact(), contact => self.surfaces_pressed_by(&contact, at))
    }

    fn surfaces_pressed_by<C: PlanetContact>(&self, contact: &C, at: &Point<N>) -> Option<MeshLoads<S, N>> {
        if !C::Load::PRESSES {
            return None;
        }
        Some(self.mesh_surface_loads(at, &self.loads(at, |state, to| contact.write(state, to))))
    }

    /// Elastic energy of all meshes [J].
    pub fn elastic_energy(&self, at: &Point<N>) -> f64 {
        with_contact!(S::MAY_ACT, self.contact(), contact => self.energy_of(&contact, at))
    }

    fn energy_of<C: PlanetContact>(&self, contact: &C, at: &Point<N>) -> f64 {
        let mut energy = S::ByGroup::filled(0.0);
        for g in 0..self.groups() {
            energy[g] = match self.twin_under::<C::Load>(at, g) {
                Some(twin) => energy[twin],
                None => contact.energy(&self.planet_state(at, g)),
            };
        }
        self.sum(|g| self.members(g) * energy[g])
    }

    /// Elastic energy that tooth pairs of the mesh of group `g` with side `s` add when they enter or leave contact
    /// between two points [J]. Both meshes may do so at the same time. The left mesh is therefore evaluated with the
    /// right mesh before its change, and the right mesh with the left mesh after its change.
    pub(in crate::model) fn energy_brought(&self, [before, after]: [&Point<N>; 2], g: usize, s: usize) -> f64 {
        let [from, to] = if s == 0 { [[before, before], [after, before]] } else { [[after, before], [after, after]] };
        let state = |at: [&Point<N>; 2]| {
            let [mut left, right] = at.map(|at| self.planet_state(at, g));
            (left.position[1], left.rate[1]) = (right.position[1], right.rate[1]);
            left
        };
        with_contact!(S::MAY_ACT, self.contact(), contact => contact.energy_gained(&state(from), &state(to)))
    }

    /// Torques of the teeth of one planet of group `g` on both side gears, without relative motion [N·m].
    pub(in crate::model) fn planet_torques(&self, at: &Point<N>, g: usize) -> [f64; 2] {
        let still = &Point { q: at.q, v: [0.0; N] };
        let side = self.teeth.sin_base[1];
        with_contact!(S::MAY_ACT, self.contact(), contact => Self::force_of(&contact, &self.planet_state(still, g)).map(|force| side * force))
    }

    /// Forces along q of both meshes.
    fn force_of<C: PlanetContact>(contact: &C, at: &PlanetState) -> [f64; 2] {
        let mut loads = [C::Load::none(); 2];
        contact.write(at, &mut loads);
        loads.map(|load| load.force()[Q])
    }

    /// Fraction of a step of `h` [s] from `at` after which a force has its first kink; `None` if no kink is expected.
    #[inline]
    pub(super) fn first_kink(&self, at: &Point<N>, h: f64) -> Option<f64> {
        let mut first = if S::MAY_ACT { self.kink_of_effects(at, h) } else { None };
        with_contact!(S::MAY_ACT, self.contact(), contact => {
            for g in (0..self.groups()).filter(|&g| self.twin(at, g).is_none()) {
                first = match (first, contact.kink(&self.planet_state(at, g), h)) {
                    (Some(a), Some(b)) => Some(a.min(b)),
                    (a, b) => a.or(b),
                };
            }
            first
        })
    }

    /// Calls `see` for each loaded tooth pair of the planets of group `g`, or for each loaded slice of it. Compiled
    /// once for all callers.
    #[inline(never)]
    pub fn visit_loads(&self, at: &Point<N>, g: usize, visit: &Visit, see: &mut Visitor) {
        let state = &self.planet_state(at, g);
        with_contact!(S::MAY_ACT, self.contact(), contact => contact.visit(state, visit, see));
    }

    /// Face load factor K_Hβ of the tooth pair of group `g` to which the loaded `slice` belongs.
    pub(in crate::model) fn face_load_factor(&self, pair: &Pair, at: &Point<N>, g: usize, slice: &ToothLoad) -> f64 {
        let state = &self.planet_state(at, g);
        with_contact!(S::MAY_ACT, self.contact(), contact => contact.face_load_factor(state, slice, pair))
    }

    /// True if loads differ over the face and are summed over it.
    pub(in crate::model) fn is_sliced(&self) -> bool {
        S::MAY_ACT
            && (self.teeth.contact.in_detail || self.is_tooth_broken)
            && self.teeth.contact.detailed.face.is_distributed()
    }
}

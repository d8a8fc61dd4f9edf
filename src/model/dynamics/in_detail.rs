//! Meshes in detail: loads of all slices with their derivatives by the variables of one mesh.

use super::friction::MeshLoads;
use super::ledger_rates::LedgerRates;
use super::{Acted, Equations, Jacobian};
use crate::contact::detailed::{
    Detailed, DetailedLoad, DetailedState, LOCAL, MeshTeeth, SharedTeeth, SliceLoad, WITH_OTHER,
};
use crate::contact::mesh::MeshState;
use crate::contact::shared::OpeningByOthers;
use crate::contact::{Flank, FlankGaps, ToothFriction};
use crate::integrate::Point;
use crate::model::effect_kinds::SurfaceLoad;
use crate::model::scene::CARRIER;
use crate::model::setup::CONTACT_HEAT;
use crate::numeric::{Dual, Scalar, sqrt};

/// Numbers, or numbers with derivatives by the variables of one mesh.
pub trait Local: Scalar {
    /// Loads of a mesh.
    fn load(mesh: &Detailed, teeth: &MeshTeeth, state: &DetailedState) -> DetailedLoad<Self>;
    /// Loads of both meshes of a planet on elastic bodies.
    fn load_shared(mesh: &Detailed, teeth: &SharedTeeth, states: &[DetailedState; 2]) -> [DetailedLoad<Self>; 2];
    /// Whether they have derivatives by the positions of the planet's other mesh.
    const BY_OTHER: bool = false;
    /// Derivatives by the variables of the mesh, then by the positions of the other; zero for plain numbers.
    fn slopes(&self) -> [f64; WITH_OTHER];
}

/// Loads with other numbers.
fn converted<const A: usize, const B: usize>(load: DetailedLoad<Dual<A>>) -> DetailedLoad<Dual<B>> {
    load.map(|from| {
        let mut d = [0.0; B];
        d.iter_mut().zip(from.d).for_each(|(to, from)| *to = from);
        Dual { v: from.v, d }
    })
}

impl Local for f64 {
    #[inline]
    fn load(mesh: &Detailed, teeth: &MeshTeeth, state: &DetailedState) -> DetailedLoad<Self> {
        mesh.load(teeth, state)
    }
    #[inline]
    fn load_shared(mesh: &Detailed, teeth: &SharedTeeth, states: &[DetailedState; 2]) -> [DetailedLoad<Self>; 2] {
        mesh.load_shared(teeth, states)
    }
    #[inline]
    fn slopes(&self) -> [f64; WITH_OTHER] {
        [0.0; WITH_OTHER]
    }
}

impl Local for Dual<LOCAL> {
    #[inline]
    fn load(mesh: &Detailed, teeth: &MeshTeeth, state: &DetailedState) -> DetailedLoad<Self> {
        mesh.linearise(teeth, state)
    }
    #[inline]
    fn load_shared(mesh: &Detailed, teeth: &SharedTeeth, states: &[DetailedState; 2]) -> [DetailedLoad<Self>; 2] {
        mesh.linearise_shared(teeth, states).map(converted)
    }
    #[inline]
    fn slopes(&self) -> [f64; WITH_OTHER] {
        let [q, x, w, dq, dx, dw] = self.d;
        [q, x, w, dq, dx, dw, 0.0, 0.0, 0.0]
    }
}

impl Local for Dual<WITH_OTHER> {
    #[inline]
    fn load(mesh: &Detailed, teeth: &MeshTeeth, state: &DetailedState) -> DetailedLoad<Self> {
        converted(mesh.linearise(teeth, state))
    }
    #[inline]
    fn load_shared(mesh: &Detailed, teeth: &SharedTeeth, states: &[DetailedState; 2]) -> [DetailedLoad<Self>; 2] {
        mesh.linearise_shared(teeth, states)
    }
    const BY_OTHER: bool = true;
    #[inline]
    fn slopes(&self) -> [f64; WITH_OTHER] {
        self.d
    }
}

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    /// Whether the meshes are summed in detail: where an effect needs it, and once a tooth is broken.
    #[inline]
    pub(in crate::model) fn in_detail(&self) -> bool {
        self.teeth.effect_terms.in_detail || self.is_tooth_broken
    }

    /// Gaps of the teeth as they are now.
    pub(in crate::model) fn gaps(&self) -> Option<&FlankGaps> {
        self.teeth.effect_terms.gaps[usize::from(self.is_tooth_broken)].as_deref()
    }

    /// State of the mesh of group `g` with side `s` in detail.
    #[inline]
    pub(super) fn detailed_state(&self, at: &Point<N>, g: usize, s: usize) -> DetailedState {
        let MeshState { position: [q, x], rate: [dq, dx], .. } = self.mesh_state(at, g, s);
        let [w, dw] = if self.has_pins() { [at.q[self.seat(s)], at.v[self.seat(s)]] } else { [0.0; 2] };
        DetailedState { position: [q, x, w], rate: [dq, dx, dw], wrapped: self.wrapped(g, s) }
    }

    /// States of both meshes of group `g` in detail.
    pub(super) fn detailed_states(&self, at: &Point<N>, g: usize) -> [DetailedState; 2] {
        [0, 1].map(|s| self.detailed_state(at, g, s))
    }

    /// Teeth of the mesh of group `g` with side `s` as they are now.
    pub(super) fn mesh_teeth(&self, g: usize, s: usize) -> MeshTeeth<'_> {
        MeshTeeth {
            engagement: &self.teeth.mesh.engagement,
            gaps: self.gaps().map(|gaps| gaps as _),
            viscosity: self.acting.oil_viscosity.map(|oil| oil.dynamic),
            planet: self.teeth.plan.group(g).planet,
            side: s,
        }
    }

    /// Friction along the flanks, with the viscosity of the oil as it is now.
    pub(in crate::model) fn flank_friction(&self) -> Option<ToothFriction> {
        let friction = self.teeth.effect_terms.detailed.friction?;
        Some(self.acting.oil_viscosity.map_or(friction, |oil| friction.with_viscosity(oil.dynamic)))
    }

    /// The fraction of a step of `h` [s] from `at` on after which the force of the mesh of group `g` with side `s` has its
    /// first kink; `opening_by_others` tells what others move its pairs by.
    #[inline]
    pub(super) fn mesh_kink(
        &self,
        at: &Point<N>,
        h: f64,
        (g, s): (usize, usize),
        opening_by_others: Option<&OpeningByOthers>,
    ) -> Option<f64> {
        let (mesh, state) = (&self.teeth.mesh, self.mesh_state(at, g, s));
        let moved_by =
            |flank: Flank, number: i64| opening_by_others.map_or(0.0, |openings| openings.of(s, flank, number));
        if WITH_EFFECTS && self.in_detail() {
            let (teeth, detailed) = (self.mesh_teeth(g, s), &self.teeth.effect_terms.detailed);
            if teeth.gaps.is_some() {
                let in_detail = self.detailed_state(at, g, s);
                return mesh.kink_of_open(&state, h, |flank, number, place| {
                    detailed.opened(&teeth, &in_detail, (flank, number, place), mesh.cone) + moved_by(flank, number)
                });
            }
        }
        if opening_by_others.is_some() {
            return mesh.kink_of_open(&state, h, |flank, number, _| moved_by(flank, number));
        }
        mesh.kink(&state, h)
    }

    /// Loads of the mesh of group `g` with side `s` in detail; calls `look` with each loaded slice.
    pub(in crate::model) fn detail(
        &self,
        at: &Point<N>,
        g: usize,
        s: usize,
        mut look: impl FnMut(&SliceLoad),
    ) -> DetailedLoad<f64> {
        if let Some(bodies) = self.bodies_of_gears() {
            let mut look = |slice: &SliceLoad| {
                if slice.name.side == s {
                    look(slice);
                }
            };
            let (teeth, states) = (&self.shared_teeth(bodies, g), &self.detailed_states(at, g));
            return self.teeth.effect_terms.detailed.look_shared(teeth, states, &mut look)[s];
        }
        self.teeth.effect_terms.detailed.look(&self.mesh_teeth(g, s), &self.detailed_state(at, g, s), &mut look)
    }

    /// Degree of freedom that carries the planets of group `g` around: their pin, or the carrier.
    pub(super) fn orbit(&self, g: usize) -> usize {
        if self.has_pins() { self.pin(g) } else { CARRIER }
    }

    /// Centrifugal force m r ω² of a planet of group `g`, away from the apex [N], and its slope by ω [N·s/rad].
    pub(super) fn centrifugal(&self, at: &Point<N>, g: usize) -> [f64; 2] {
        let per_speed = self.teeth.effect_terms.planet_mass_moment * at.v[self.orbit(g)];
        [per_speed * at.v[self.orbit(g)], 2.0 * per_speed]
    }

    /// Loads on the rubbing surfaces of side gears and planets, from the loads of all meshes and the planets' orbit.
    pub(in crate::model) fn mesh_surface_loads<T: Local>(
        &self,
        at: &Point<N>,
        loads: &[[DetailedLoad<T>; 2]; G],
    ) -> MeshLoads<G> {
        let side = self.teeth.sin_base[1];
        let sides = [0, 1].map(|s| SurfaceLoad {
            thrust: self.sum(|g| self.members(g) * loads[g][s].side_axial.value()),
            load: self.sum(|g| self.members(g) * side * loads[g][s].force[0].value()).abs(),
        });
        let planets = self.by_group(|g| {
            let [l, r] = &loads[g];
            let across = l.tangential.value() + r.tangential.value();
            let along = l.side_axial.value() - r.side_axial.value();
            SurfaceLoad {
                thrust: l.planet_axial.value() + r.planet_axial.value() + self.centrifugal(at, g)[0],
                load: sqrt(across * across + along * along),
            }
        });
        (sides, planets)
    }

    pub(in crate::model) fn all_loads<T: Local>(&self, at: &Point<N>) -> [[DetailedLoad<T>; 2]; G] {
        let mut loads = [[DetailedLoad::zero(); 2]; G];
        for g in 0..self.groups() {
            self.write_planet_loads(at, g, &mut loads[g]);
        }
        loads
    }

    /// Meshes in detail under their `loads`, and the dry friction that these cause.
    pub(in crate::model) fn act_in_detail<T: Local>(
        &self,
        at: &Point<N>,
        loads: &[[DetailedLoad<T>; 2]; G],
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
        jacobian: Option<&mut Jacobian<'_, N>>,
    ) {
        self.add_forces(|g, s| [loads[g][s].force[0].value(), loads[g][s].force[1].value()], sum);
        if self.has_pins() {
            for s in 0..2 {
                sum[self.seat(s)] += self.sum(|g| self.members(g) * loads[g][s].force[2].value());
            }
        }
        for (i, place) in [CONTACT_HEAT, self.teeth.effect_terms.friction_heat_index].into_iter().enumerate() {
            if i == 0 || place != CONTACT_HEAT {
                ledger_rates.heat[place] = self.sum(|g| self.members(g) * (loads[g][0].heat[i] + loads[g][1].heat[i]));
            }
        }
        let surfaces = self.rubs().then(|| self.mesh_surface_loads(at, loads));
        self.add_friction(at, surfaces.as_ref(), sum, ledger_rates);
        if let Some(j) = jacobian {
            let block = |part: usize| {
                self.by_group(|g| {
                    [0, 1].map(|s| {
                        let force: [[f64; WITH_OTHER]; 3] = loads[g][s].force.map(|f| f.slopes());
                        self.local_block(s, &force.map(|d| [d[part], d[part + 1], d[part + 2]]))
                    })
                })
            };
            j.elastic_energy = self.sum(|g| self.members(g) * (loads[g][0].energy + loads[g][1].energy));
            self.add_blocks::<false>(&block(0), j.by_position);
            self.add_blocks::<false>(&block(3), &mut j.by_rate);
            if T::BY_OTHER {
                self.add_blocks::<true>(&self.cross_blocks(loads), j.by_position);
            }
            if let Some(surfaces) = &surfaces {
                self.friction_slopes_by_loads(at, loads, surfaces, j);
                self.friction_slopes_by_orbit(at, &surfaces.1, j);
            }
            self.friction_slopes_under(at, surfaces.as_ref(), j);
        }
    }

    /// Elastic energy of the mesh of group `g` with side `s` [J].
    pub(in crate::model) fn mesh_energy(&self, at: &Point<N>, g: usize, s: usize) -> f64 {
        let effect_terms = &self.teeth.effect_terms;
        if !(WITH_EFFECTS && self.in_detail()) {
            return self.teeth.mesh.energy(&self.mesh_state(at, g, s));
        }
        effect_terms.detailed.energy(&self.mesh_teeth(g, s), &self.detailed_state(at, g, s))
    }
}

//! Equations of motion with tooth contact.
//!
//! Degrees of freedom: α_L, α_R (side gears relative to the carrier), θ_c, and the spin ψ of each group of planets;
//! velocities ω_L, ω_R, ω_c (absolute) and ψ̇, in which the kinetic energy is diagonal:
//!
//!   J_s ω̇_s = Σ Q_α − T_s,   J_c ω̇_c = T_c − Σ_s Σ Q_α,   I_p ψ̈ = Q_ψL + Q_ψR,   α̇_s = ω_s − ω_c
//!
//! with q = sinδ_bs α − σ sinδ_bp ψ and x = σ sinδ_bp ψ + h of every mesh, σ = +1 left, −1 right, and the mesh forces
//! Q_α = sinδ_bs F_q, Q_ψ = σ sinδ_bp (F_x − F_q). Imposed motions have a given acceleration.
//!
//! Effects may add degrees of freedom: axial seats w of the side gears, pins that turn by β beyond the carrier (then
//! α − β takes the place of α and the reaction goes to the pin), ends of the half-shafts with the twist as position.

use super::friction::by_body;
use super::ledger_rates::LedgerRates;
use super::sizes::EXACT;
use super::{Acted, Acting, Largest, State};
use crate::contact::Law;
use crate::contact::mesh::{MeshForce, MeshJacobian, MeshState};
use crate::integrate::{Point, SecondOrder};
use crate::model::assembly::{SIGMA, Teeth};
use crate::model::effect_kinds::{FrictionSource, SurfaceLoad};
use crate::model::scene::attached::ENDS;
use crate::model::scene::layout::{LEFT, over_groups};
use crate::model::scene::{CARRIER, FRICTION_BODIES, Inputs, Layout, MAX_GROUPS, PLANET, Plan};
use crate::numeric::lanes;

/// The equations under given inputs, and whether effects act. Plain teeth, and small scenes with effects, have exactly `N`
/// degrees of freedom and `G` groups of planets; in larger ones these are the most there can be, and the layout tells how
/// many there are.
#[derive(Clone, Copy)]
pub struct Equations<'a, const N: usize, const G: usize, const WITH_EFFECTS: bool> {
    /// Constants.
    pub teeth: &'a Teeth,
    pub(in crate::model) acting: Acting,
    pub(in crate::model) is_tooth_broken: bool,
    /// Relative position taken out by wrapping, by group and side [rad].
    offset: [[f64; 2]; MAX_GROUPS],
    /// Pitches by which the planets have been wrapped, in the sense of x of the left mesh.
    wrapped: [i64; MAX_GROUPS],
}

impl<'a, const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'a, N, G, WITH_EFFECTS> {
    /// Whether there are `N` degrees of freedom and `G` groups of planets exactly: without moving pins and seats, and with ends of
    /// half-shafts in the largest of these sizes alone.
    pub(super) const EXACT: bool = !WITH_EFFECTS || N <= EXACT;

    /// Equations at `state`'s wrapping under `inputs`.
    pub fn new(teeth: &'a Teeth, inputs: &Inputs, state: &State) -> Self {
        let mut offset = [[0.0; 2]; MAX_GROUPS];
        let mut wrapped = [0; MAX_GROUPS];
        for g in 0..teeth.layout.groups {
            wrapped[g] = state.whole_periods[teeth.layout.planet(g)];
            for s in 0..2 {
                let spin = if s == 0 { wrapped[g] } else { -wrapped[g] };
                offset[g][s] = teeth.base_pitch * (state.whole_periods[LEFT + s] - spin) as f64;
            }
        }
        let acting = Acting::new(WITH_EFFECTS.then_some(&teeth.effect_terms.body_effects), inputs, state);
        Self { teeth, acting, is_tooth_broken: state.is_tooth_broken, offset, wrapped }
    }

    /// Groups of planets.
    #[inline]
    pub(in crate::model) fn groups(&self) -> usize {
        if Self::EXACT { G } else { self.teeth.layout.groups.min(G) }
    }

    /// Σ over the groups of planets.
    #[inline]
    pub(in crate::model) fn sum(&self, term: impl Fn(usize) -> f64) -> f64 {
        over_groups(self.groups(), term)
    }

    /// What `of` gives for each group of planets.
    #[inline]
    pub(in crate::model) fn by_group<T: Copy + Default>(&self, of: impl Fn(usize) -> T) -> [T; G] {
        let mut all = [T::default(); G];
        for g in 0..self.groups() {
            all[g] = of(g);
        }
        all
    }

    /// Whether pins and seats move.
    #[inline]
    pub(in crate::model) fn has_pins(&self) -> bool {
        !Self::EXACT && self.teeth.layout.has_pins
    }

    /// Index of the planets of group `g`.
    #[inline]
    pub(in crate::model) fn planet(&self, g: usize) -> usize {
        if Self::EXACT { PLANET + g } else { self.teeth.layout.planet(g) }
    }

    /// Index of the pin of group `g`.
    #[inline]
    pub(in crate::model) fn pin(&self, g: usize) -> usize {
        self.teeth.layout.pin(g)
    }

    /// Index of the axial seat of side gear `s`.
    #[inline]
    pub(in crate::model) fn seat(&self, s: usize) -> usize {
        self.teeth.layout.seat(s)
    }

    /// Index of the end of the half-shaft of side `s`.
    #[inline]
    pub(in crate::model) fn end(&self, s: usize) -> usize {
        if Self::EXACT { PLANET + G + s } else { self.teeth.layout.end(s) }
    }

    /// Ends of half-shafts with the side gears they turn against, in a size that is exact: the only bodies attached there.
    #[inline]
    pub(in crate::model) fn exact_ends(&self) -> impl Iterator<Item = (usize, usize)> + use<N, G, WITH_EFFECTS> {
        (0..if Self::EXACT && self.has_ends() { ENDS } else { 0 }).map(|s| (PLANET + G + s, s))
    }

    /// Whether anything is attached.
    #[inline]
    pub(in crate::model) fn is_attached(&self) -> bool {
        if Self::EXACT { self.has_ends() } else { self.teeth.layout.is_attached() }
    }

    /// Degrees of freedom.
    #[inline]
    pub(in crate::model) fn count(&self) -> usize {
        if Self::EXACT { N } else { self.teeth.layout.count().min(N) }
    }

    /// Whether inputs change while they act.
    #[inline]
    pub(in crate::model) fn is_driven_by_inputs(&self) -> bool {
        WITH_EFFECTS && self.acting.driven
    }

    /// The same equations in the size that every scene fits in.
    pub(in crate::model) fn largest(&self) -> Largest<'_> {
        let Self { teeth, acting, is_tooth_broken, offset, wrapped } = *self;
        Largest { teeth, acting, is_tooth_broken, offset, wrapped }
    }

    /// State of the mesh of group `g` with side `s`.
    #[inline]
    pub fn mesh_state(&self, at: &Point<N>, g: usize, s: usize) -> MeshState {
        let [planet, side] = self.teeth.sin_base;
        let turn = SIGMA[s] * planet;
        let (travel, travel_rate) = (turn * at.q[self.planet(g)], turn * at.v[self.planet(g)]);
        let (angle, speed) = if !self.has_pins() {
            (at.q[s], at.v[s] - at.v[CARRIER])
        } else {
            (at.q[s] - at.q[self.pin(g)], at.v[s] - at.v[self.pin(g)])
        };
        MeshState {
            position: [side * angle - travel + self.offset[g][s], travel + self.teeth.plan.group(g).phase[s]],
            rate: [side * speed - travel_rate, travel_rate],
            which: [self.teeth.plan.group(g).planet, s],
        }
    }

    /// Writes the force of a plain mesh: part of the steps where these are compiled for just this size, and one function for all
    /// others.
    #[inline]
    pub(super) fn write_force(&self, state: &MeshState, to: &mut MeshForce) {
        if Self::EXACT { self.teeth.mesh.write_force(state, to) } else { self.teeth.mesh.write_force_apart(state, to) }
    }

    /// The same linearised.
    #[inline]
    pub(super) fn mesh_linearised(&self, state: &MeshState) -> (MeshForce, MeshJacobian) {
        if Self::EXACT { self.teeth.mesh.linearise(state) } else { self.teeth.mesh.linearise_apart(state) }
    }

    /// A group before `g` whose plain meshes are in the same state to the last bit: what its teeth do, those of `g` do too.
    /// Planets that are simulated one by one move together until something tells them apart, such as a tooth that breaks.
    #[inline]
    pub(in crate::model) fn twin(&self, at: &Point<N>, g: usize) -> Option<usize> {
        if self.groups() == 1 || matches!(self.teeth.mesh.law, Law::Solid(_)) {
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

    /// Pitches by which the planets of group `g` have been wrapped, in the sense of x of the mesh with side `s`.
    #[inline]
    pub(in crate::model) fn wrapped(&self, g: usize, s: usize) -> i64 {
        if s == 0 { self.wrapped[g] } else { -self.wrapped[g] }
    }

    #[inline]
    pub(in crate::model) fn members(&self, g: usize) -> f64 {
        self.teeth.plan.group(g).members
    }

    /// Adds mesh forces (conjugate to q and x) to side gears, carrier or pins, and planets.
    #[inline]
    pub(in crate::model) fn add_forces(&self, force: impl Fn(usize, usize) -> [f64; 2], sum: &mut [f64; N]) {
        let [planet, side] = self.teeth.sin_base;
        let on = |s: usize| self.sum(|g| self.members(g) * side * force(g, s)[0]);
        let on_side = [on(0), on(1)];
        for s in 0..2 {
            sum[s] += on_side[s];
        }
        if !self.has_pins() {
            sum[CARRIER] -= on_side[0] + on_side[1];
        }
        for g in 0..self.groups() {
            let (left, right) = (force(g, 0), force(g, 1));
            sum[self.planet(g)] += planet * ((left[1] - left[0]) - (right[1] - right[0]));
            if self.has_pins() {
                sum[self.pin(g)] -= side * left[0] + side * right[0];
            }
        }
    }

    /// Turns sums of forces into accelerations, given those of imposed motions; completes the ledger rates.
    #[inline(always)]
    pub(in crate::model) fn finish(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        imposed: &[f64; N],
        ledger_rates: &mut LedgerRates,
    ) {
        let (plan, inverse) = (&self.teeth.plan, &self.teeth.inverse_inertia);
        let rates = &self.acting.input_derivatives.rates[0];
        let mut input = 0.0;
        for s in 0..2 {
            let wheel = if WITH_EFFECTS { self.wheel(s) } else { s };
            if WITH_EFFECTS && plan.side_imposed[s] {
                input += (self.teeth.inertia[wheel] * rates.side_speed[s] - sum[wheel]) * at.v[wheel];
            } else {
                sum[wheel] -= self.acting.inputs.load_torque[s];
                input -= self.acting.inputs.load_torque[s] * at.v[wheel];
            }
        }
        let drive = if plan.carrier_imposed {
            self.teeth.inertia[CARRIER] * imposed[CARRIER] - sum[CARRIER]
        } else {
            self.acting.inputs.carrier_torque + if WITH_EFFECTS { ledger_rates.drive } else { 0.0 }
        };
        input += drive * at.v[CARRIER];
        sum[CARRIER] += drive;
        if plan.spin_imposed {
            let inertial = if WITH_EFFECTS { self.teeth.inertia[self.planet(0)] * rates.planet_spin } else { 0.0 };
            input -= self.sum(|g| self.members(g) * (sum[self.planet(g)] - inertial) * at.v[self.planet(g)]);
        }
        for (sum, inverse) in sum.iter_mut().zip(inverse) {
            *sum *= inverse;
        }
        if WITH_EFFECTS && plan.carrier_imposed {
            sum[CARRIER] = imposed[CARRIER];
        }
        if self.is_driven_by_inputs() {
            for g in (0..self.groups()).filter(|_| plan.spin_imposed) {
                sum[self.planet(g)] = rates.planet_spin;
            }
            for s in (0..2).filter(|&s| plan.side_imposed[s]) {
                sum[self.end(s)] = rates.side_speed[s];
            }
        }
        ledger_rates.input += input;
    }

    /// Adds tooth torques without any input to the sums of side gears, carrier, planets and pins; returns the heat of contact.
    #[inline(never)]
    pub fn add_tooth_torques(&self, at: &Point<N>, sum: &mut [f64; N]) -> f64 {
        let mut load = [[MeshForce::default(); 2]; G];
        for g in 0..self.groups() {
            if let Some(twin) = self.twin(at, g) {
                load[g] = load[twin];
                continue;
            }
            if let Some(bodies) = self.bodies_of_gears() {
                load[g] = self.forces_on_bodies(bodies, at, g);
                continue;
            }
            for s in 0..2 {
                self.write_force(&self.mesh_state(at, g, s), &mut load[g][s]);
            }
        }
        let mut all = *sum;
        self.add_forces(|g, s| load[g][s].force, &mut all);
        lanes::write(all, sum);
        self.sum(|g| self.members(g) * (load[g][0].heat + load[g][1].heat))
    }

    /// Elastic energy of all meshes [J].
    pub fn elastic_energy(&self, at: &Point<N>) -> f64 {
        let mut energy = [0.0; G];
        for g in 0..self.groups() {
            let of = |s| self.teeth.mesh.energy(&self.mesh_state(at, g, s));
            energy[g] = match (self.twin(at, g), self.bodies_of_gears()) {
                (Some(twin), _) => energy[twin],
                (None, None) => of(0) + of(1),
                (None, Some(bodies)) => self.energy_on_bodies(bodies, [at, at], g),
            };
        }
        self.sum(|g| self.members(g) * energy[g])
    }

    /// Kinetic energy [J].
    pub fn kinetic_energy(&self, at: &Point<N>) -> f64 {
        let twice_energy = |i: usize| self.teeth.inertia[i] * at.v[i] * at.v[i];
        let planets = self.sum(|g| {
            self.members(g)
                * (twice_energy(self.planet(g)) + if self.has_pins() { twice_energy(self.pin(g)) } else { 0.0 })
        });
        let others = |range: std::ops::Range<usize>| range.map(twice_energy).sum::<f64>();
        let behind = self.inner().end;
        0.5 * (others(0..self.planet(0)) + planets + others(behind..self.count()))
    }

    /// Largest approach of any flank pair [rad], negative inside the lash, with its group and side.
    #[inline]
    pub fn deepest(&self, at: &Point<N>) -> (f64, usize, usize) {
        self.deepest_of_touching(at).0
    }

    /// Largest approach of any flank pair as in [`Self::deepest`], and the meshes whose flanks touch, one bit for each.
    #[inline]
    pub fn deepest_of_touching(&self, at: &Point<N>) -> ((f64, usize, usize), u8) {
        let (mut deepest, mut touching) = ((f64::NEG_INFINITY, 0, 0), 0);
        for g in (0..self.groups()).filter(|&g| self.twin(at, g).is_none()) {
            for s in 0..2 {
                let approach = self.teeth.mesh.approach(self.mesh_state(at, g, s).position[0]);
                touching |= u8::from(approach > 0.0) << (2 * g + s);
                if approach > deepest.0 {
                    deepest = (approach, g, s);
                }
            }
        }
        (deepest, touching)
    }
}

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Acted<N> for Equations<'_, N, G, WITH_EFFECTS> {
    #[inline]
    fn acting(&self) -> &Acting {
        &self.acting
    }

    #[inline]
    fn acting_mut(&mut self) -> &mut Acting {
        &mut self.acting
    }

    #[inline]
    fn friction_sources(&self) -> &[FrictionSource] {
        if WITH_EFFECTS { &self.teeth.effect_terms.body_effects.friction } else { &[] }
    }

    #[inline]
    fn plan(&self) -> &Plan {
        &self.teeth.plan
    }

    #[inline]
    fn layout(&self) -> &Layout {
        &self.teeth.layout
    }

    #[inline]
    fn rubs(&self) -> bool {
        WITH_EFFECTS && self.acting.rubs
    }

    #[inline]
    fn has_ends(&self) -> bool {
        if Self::EXACT { WITH_EFFECTS && N == EXACT } else { self.teeth.layout.has_ends() }
    }

    #[inline]
    fn sticking(&self) -> &[f64] {
        &self.teeth.layout.members[..self.groups()]
    }

    fn mesh_loads(&self, at: &Point<N>) -> [SurfaceLoad; FRICTION_BODIES] {
        let pressed = self.acting.friction().depends_on_load();
        by_body(pressed.then(|| self.mesh_surface_loads(at, &self.all_loads::<f64>(at))).as_ref())
    }

    fn acceleration_at(&self, at: &Point<N>, time: f64) -> [f64; N] {
        self.accelerate_at(at, time)
    }

    fn acceleration_by_inputs(&self, at: &Point<N>) -> [f64; N] {
        let (mut sum, mut imposed, mut ledger_rates) = ([0.0; N], [0.0; N], LedgerRates::default());
        self.add_brakes(at, &mut sum);
        self.act_on_bodies(at, &mut sum, &mut imposed, &mut ledger_rates);
        self.finish(at, &mut sum, &imposed, &mut ledger_rates);
        sum
    }
}

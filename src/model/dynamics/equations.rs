//! Equations of motion with tooth contact.
//!
//! Degrees of freedom: α_L, α_R (side gears relative to the carrier), θ_c, and the spin ψ of each group of planets;
//! velocities ω_L, ω_R, ω_c (absolute) and ψ̇, in which the kinetic energy is diagonal:
//!
//!   J_s ω̇_s = Σ Q_α − T_s,   J_c ω̇_c = T_c − Σ_s Σ Q_α,   I_p ψ̈ = Q_ψL + Q_ψR,   α̇_s = ω_s − ω_c
//!
//! Forces are computed in this order, together with their derivatives:
//!
//! 1. contact of each planet with both side gears (`planet_contact`),
//! 2. forces of the contact on the bodies (`mesh_transform`),
//! 3. dry friction under the loads of the contact (`dry_friction`),
//! 4. effects on bodies (`Equations::act_on_bodies`),
//! 5. inputs and imposed motions, which have a given acceleration (`Equations::finish`).
//!
//! Effects may add degrees of freedom: axial seats w of the side gears, pins that turn by β relative to the carrier,
//! and ends of half-shafts with the twist as position. With pins, α − β replaces α, and the reaction acts on the pin.

use std::marker::PhantomData;
use std::ops::Range;

use super::driven::Driven;
use super::ledger_rates::LedgerRates;
use super::shape::{Any, ByGroup, MAX_SIZE, Shape};
use super::{FrictionEquations, InputsAndFriction, State};
use crate::integrate::{Matrix, Point, SecondOrder};
use crate::model::assembly::{BodyEffects, Teeth};
use crate::model::effect_kinds::{Action, Slopes, SurfaceLoad};
use crate::model::scene::layout::{LEFT, over_groups};
use crate::model::scene::{CARRIER, Inputs, Layout, MAX_GROUPS, PAIRS, Plan};
use crate::model::setup::HEATS;

/// Equations under given inputs, in the shape `S` with at most `N` degrees of freedom.
#[derive(Clone, Copy)]
pub struct Equations<'a, S, const N: usize> {
    /// Constants.
    pub teeth: &'a Teeth,
    pub(in crate::model) applied: InputsAndFriction,
    /// Terms that inputs add while they change.
    pub(super) driven: Driven<N>,
    pub(in crate::model) is_tooth_broken: bool,
    /// Relative position removed by wrapping, by group and side [rad].
    pub(super) offset: [[f64; 2]; MAX_GROUPS],
    /// Number of pitches by which planets have been wrapped, in the direction of x of the left mesh.
    wrapped: [i64; MAX_GROUPS],
    shape: PhantomData<S>,
}

/// Equations with teeth in the shape that fits any scene, for computations outside the loop over the steps.
pub type Largest<'a> = Equations<'a, Any, MAX_SIZE>;

impl<'a, const N: usize, S: Shape<N>> Equations<'a, S, N> {
    /// Equations under `inputs` with the wrapping of `state`.
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
        let mut applied = InputsAndFriction::without_friction(inputs, state);
        if S::MAY_ACT {
            applied.add(&teeth.effect_terms.body_effects, state);
        }
        let is_tooth_broken = state.is_tooth_broken;
        let mut these =
            Self { teeth, applied, driven: Driven::NO, is_tooth_broken, offset, wrapped, shape: PhantomData };
        if let Some(derivatives) = &state.inputs.derivatives {
            these.driven = these.driven_terms(derivatives);
        }
        if S::MAY_ACT && these.applied.has_moving_actuators() {
            these.driven = Driven::SCALES;
        }
        these
    }

    /// Number of planet groups.
    #[inline]
    pub(in crate::model) fn groups(&self) -> usize {
        S::groups(&self.teeth.layout)
    }

    /// Σ over the groups of planets.
    #[inline]
    pub(in crate::model) fn sum(&self, term: impl Fn(usize) -> f64) -> f64 {
        over_groups(self.groups(), term)
    }

    /// Values `of` the planet groups. Entries beyond the last group are `none`.
    #[inline]
    pub(super) fn by_group<T: Copy>(&self, none: T, of: impl Fn(usize) -> T) -> S::ByGroup<T> {
        let mut all = S::ByGroup::filled(none);
        for g in 0..self.groups() {
            all[g] = of(g);
        }
        all
    }

    /// Number of planets in group `g`.
    #[inline]
    pub(in crate::model) fn members(&self, g: usize) -> f64 {
        self.teeth.plan.group(g).members
    }

    /// True if pins and seats move.
    #[inline]
    pub(in crate::model) fn has_pins(&self) -> bool {
        S::has_pins(&self.teeth.layout)
    }

    /// Index of the planets of group `g`.
    #[inline]
    pub(in crate::model) fn planet(&self, g: usize) -> usize {
        S::planet(&self.teeth.layout, g)
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
        S::end(&self.teeth.layout, s)
    }

    /// Index of the body on which the drive acts.
    #[inline]
    pub(in crate::model) fn port(&self) -> usize {
        S::port(&self.teeth.layout)
    }

    /// Number of degrees of freedom.
    #[inline]
    pub(in crate::model) fn count(&self) -> usize {
        S::count(&self.teeth.layout)
    }

    /// Indices of planets and their pins.
    #[inline]
    pub(super) fn planets_and_pins(&self) -> Range<usize> {
        let (first, pins) = (self.planet(0), if self.has_pins() { self.groups() } else { 0 });
        first..first + self.groups() + pins
    }

    /// Returns these equations in the shape that fits any scene.
    pub(in crate::model) fn largest(&self) -> Largest<'_> {
        let Self { teeth, applied, is_tooth_broken, offset, wrapped, .. } = *self;
        let driven = if applied.driven { Driven::SCALES } else { Driven::NO };
        Largest { teeth, applied, driven, is_tooth_broken, offset, wrapped, shape: PhantomData }
    }

    /// Number of pitches by which planets of group `g` have been wrapped, in the direction of x of the mesh with side
    /// `s`.
    #[inline]
    pub(in crate::model) fn wrapped(&self, g: usize, s: usize) -> i64 {
        if s == 0 { self.wrapped[g] } else { -self.wrapped[g] }
    }

    /// Forces of meshes, pins and seats at rest, and their derivatives with respect to positions, for the static
    /// equilibrium.
    pub(in crate::model) fn statics(&self, at: &Point<N>) -> ([f64; N], Matrix<N>) {
        let (mut sum, mut by_position, mut by_velocity) = ([0.0; N], [[0.0; N]; N], [[0.0; N]; N]);
        self.static_contact(at, &mut sum, &mut by_position);
        let still = Point { q: at.q, v: [0.0; N] };
        let mut heat = [0.0; HEATS];
        let motion = self.body_motion(&still);
        let mut action = Action { force: &mut sum, heat: &mut heat };
        let mut slopes = Slopes::new([&mut by_position, &mut by_velocity]);
        for effect in self.teeth.effect_terms.body_effects.forces.iter().filter(|e| e.is_structure()) {
            effect.act(&motion, &mut action);
            effect.slopes(&motion, &mut slopes);
        }
        (sum, by_position)
    }

    /// Elastic energy of meshes, pins and seats [J]; with `all` also of half-shafts and stuck friction.
    pub(in crate::model) fn stored_energy(&self, at: &Point<N>, all: bool) -> f64 {
        self.elastic_energy(at) + self.stored_energy_of_bodies(at, all)
    }

    /// Elastic energy of pins and seats [J]; with `all` also of half-shafts and stuck friction.
    pub(in crate::model) fn stored_energy_of_bodies(&self, at: &Point<N>, all: bool) -> f64 {
        if !S::MAY_ACT {
            return 0.0;
        }
        let forces = &self.teeth.effect_terms.body_effects.forces;
        let motion = self.body_motion(at);
        let energy = forces.iter().filter(|e| all || e.is_structure()).map(|e| e.energy(&motion)).sum::<f64>();
        if all { energy + self.friction_energy(at) } else { energy }
    }
}

impl<const N: usize, S: Shape<N>> FrictionEquations<N> for Equations<'_, S, N> {
    #[inline]
    fn applied(&self) -> &InputsAndFriction {
        &self.applied
    }

    #[inline]
    fn applied_mut(&mut self) -> &mut InputsAndFriction {
        &mut self.applied
    }

    #[inline]
    fn body_effects(&self) -> Option<&BodyEffects> {
        S::MAY_ACT.then_some(&self.teeth.effect_terms.body_effects)
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
    fn has_dry_friction(&self) -> bool {
        S::MAY_ACT && self.applied.has_dry_friction
    }

    #[inline]
    fn may_have_ends(&self) -> bool {
        S::MAY_HAVE_ENDS
    }

    fn mesh_loads(&self, at: &Point<N>) -> [SurfaceLoad; PAIRS] {
        let is_pressed = self.applied.friction().depends_on_load();
        self.by_body(if is_pressed { self.surfaces_pressed(at) } else { None }.as_ref())
    }

    fn acceleration_at(&self, at: &Point<N>, time: f64) -> [f64; N] {
        self.accelerate_at(at, time)
    }

    fn drive_torque(&self, at: &Point<N>, time: f64) -> f64 {
        let these = if self.applied.driven && time > 0.0 { self.later(time) } else { *self };
        let mut sum = [0.0; N];
        if these.teeth.plan.drive_imposed {
            let mut ledger_rates = LedgerRates::default();
            these.act(at, &mut sum, &mut ledger_rates);
            these.brake_pinion(at, &mut sum, &mut ledger_rates);
        }
        these.drive_under(&sum)
    }

    fn carrier_mobility(&self) -> f64 {
        self.teeth.inverse_inertia[CARRIER]
    }

    fn acceleration_by_inputs(&self, at: &Point<N>) -> [f64; N] {
        let (mut sum, mut ledger_rates) = ([0.0; N], LedgerRates::default());
        self.add_commanded(at, &mut sum);
        self.act_on_bodies(at, &mut sum, &mut ledger_rates);
        self.finish(at, &mut sum, &mut ledger_rates);
        sum
    }
}

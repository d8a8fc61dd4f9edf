//! Ideal differential with effects on bodies. Willis' equation is a constraint; the remaining degrees of freedom are
//! integrated.
//!
//! Accelerations are v̇ = W Q + f u̇_c (`assembly::ideal_with_effects`). The torque of the meshes on a side gear is the
//! constraint force λ_s = J_s ω̇_s − Q_s.

use super::pinion_loss::SlidingPinion;
use super::{FrictionEquations, InputsAndFriction, Jacobian, PinionLoss, State};
use crate::integrate::{Linearisation, Point, SecondOrder};
use crate::model::assembly::BodyEffects;
use crate::model::assembly::ideal_with_effects::{IMPOSED, IdealWithEffects, Linear};
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::effect_kinds::{Action, BodyMotion, Slopes, SurfaceLoad};
use crate::model::scene::{CARRIER, Inputs, Layout, PAIRS, PLANET, Plan};
use crate::numeric::lanes;

/// Torques that follow from the constraint.
#[derive(Clone, Copy, Debug, Default)]
pub struct IdealTorques {
    /// Torque of the drive, referred to the carrier [N·m].
    pub drive: f64,
    /// Torque that imposes the spin [N·m].
    pub spin: f64,
    /// Torque of the meshes on each side gear [N·m].
    pub gears: [f64; 2],
}

/// Equations of the ideal differential under given inputs, with room for `N` degrees of freedom.
#[derive(Clone, Copy)]
pub struct IdealEquations<'a, const N: usize> {
    /// Constants.
    pub ideal: &'a IdealWithEffects,
    pub(in crate::model) applied: InputsAndFriction,
}

/// Inputs at one instant, and their rates [per s].
type InputsNow<'a> = (&'a Inputs, &'a Inputs);

impl<'a, const N: usize> IdealEquations<'a, N> {
    /// Index of the end of the half-shaft of side `s`.
    pub(super) fn end(&self, s: usize) -> usize {
        PLANET + 1 + s
    }

    /// Equations under `inputs`, with friction and temperatures of `state`.
    #[inline(never)]
    pub fn new(ideal: &'a IdealWithEffects, inputs: &Inputs, state: &State) -> Self {
        let mut equations = Self { ideal, applied: InputsAndFriction::without_friction(inputs, state) };
        equations.applied.add(&ideal.body_effects, state);
        equations
    }

    /// Calls `of` with the inputs at `time` [s] after they were set.
    #[inline(always)]
    pub(super) fn at_time<T>(&self, time: f64, of: impl FnOnce(InputsNow) -> T) -> T {
        if self.applied.driven {
            let (inputs, derivatives) = self.applied.inputs_after(Some(&self.ideal.body_effects), time);
            of((&inputs, &derivatives.rates[0]))
        } else {
            of(self.now())
        }
    }

    /// Inputs at the time at which they were set.
    #[inline(always)]
    pub(super) fn now(&self) -> InputsNow<'_> {
        (&self.applied.inputs, &self.applied.input_derivatives.rates[0])
    }

    /// Forces, including the commanded torques of motions that are not imposed, and the accelerations of imposed
    /// motions.
    pub(super) fn forces(
        &self,
        at: &Point<N>,
        now: InputsNow,
        ledger_rates: &mut LedgerRates,
    ) -> ([f64; N], [f64; IMPOSED]) {
        let mut sum = [0.0; N];
        let mut out = Action { force: &mut sum, heat: &mut ledger_rates.heat };
        let motion = self.motion(at, now);
        for effect in self.ideal.body_effects.forces.iter() {
            effect.act(&motion, &mut out);
        }
        if self.has_dry_friction() {
            self.add_friction_torques(at, &self.applied.friction().commanded_loads(now.0), &mut sum, ledger_rates);
        }
        for s in (0..2).filter(|_| self.may_have_ends()) {
            let end = self.end(s);
            let rate = at.v[s] - at.v[end];
            ledger_rates.shaft[s] =
                self.ideal.body_effects.half_shafts.torque(s, [at.q[end], rate], &self.applied.dogs);
        }
        let imposed = self.drive(at, now, &mut sum, ledger_rates);
        (sum, imposed)
    }

    /// Positions, velocities and inputs, as passed to effects.
    #[inline]
    fn motion<'b>(&'b self, at: &'b Point<N>, (inputs, input_rates): InputsNow<'b>) -> BodyMotion<'b> {
        BodyMotion { inputs, input_rates, ..self.body_motion(at) }
    }

    /// Accelerations W Q + f u̇_c.
    #[inline]
    fn accelerations(&self, sum: &[f64; N], imposed: &[f64; IMPOSED]) -> [f64; N] {
        let ideal = self.ideal;
        let mut free = [0.0; N];
        for (column, force) in ideal.mobility.iter().zip(sum) {
            lanes::add_times(&mut free, *force, column);
        }
        self.follow(free, imposed)
    }

    /// Accelerations W Q + f u̇_c for forces that do not act on planets, such as those of half-shafts.
    #[inline]
    fn accelerations_by_shafts(&self, sum: &[f64; N], imposed: &[f64; IMPOSED]) -> [f64; N] {
        let mut free = [0.0; N];
        for i in [0, 1, CARRIER, PLANET + 1, PLANET + 2] {
            lanes::add_times(&mut free, sum[i], &self.ideal.mobility[i]);
        }
        self.follow(free, imposed)
    }

    /// Adds f u̇_c to the accelerations that follow from forces.
    #[inline(always)]
    fn follow(&self, mut free: [f64; N], imposed: &[f64; IMPOSED]) -> [f64; N] {
        let ideal = self.ideal;
        if ideal.is_imposed {
            let mut following = [0.0; N];
            for (column, acceleration) in ideal.follow.iter().zip(imposed) {
                lanes::add_times(&mut following, *acceleration, column);
            }
            lanes::add_times(&mut free, 1.0, &following);
        }
        free
    }

    /// Constants of a scene in which only half-shafts act, or `None` if other effects or dry friction act.
    #[inline]
    fn linear(&self) -> Option<&'a Linear> {
        self.ideal.linear.as_deref().filter(|_| !self.has_dry_friction())
    }

    /// Forces and imposed accelerations if only half-shafts act; [`Self::forces`] would return the same values.
    #[inline(always)]
    fn forces_of_shafts(
        &self,
        linear: &Linear,
        at: &Point<N>,
        now: InputsNow,
        ledger_rates: &mut LedgerRates,
    ) -> ([f64; N], [f64; IMPOSED]) {
        let mut sum = [0.0; N];
        for s in 0..2 {
            let end = self.end(s);
            let rate = at.v[s] - at.v[end];
            let torque = self.ideal.body_effects.half_shafts.torque(s, [at.q[end], rate], &self.applied.dogs);
            sum[s] -= torque;
            sum[end] += torque;
            ledger_rates.heat[linear.heat_index] += self.ideal.body_effects.half_shafts.heat(s, rate);
            ledger_rates.shaft[s] = torque;
        }
        let imposed = self.drive(at, now, &mut sum, ledger_rates);
        (sum, imposed)
    }

    /// Adds the torques and the power of inputs. Returns the accelerations of imposed motions.
    #[inline(always)]
    fn drive(
        &self,
        at: &Point<N>,
        (inputs, rates): InputsNow,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) -> [f64; IMPOSED] {
        let (plan, has_ends) = (&self.ideal.plan, self.may_have_ends());
        for s in 0..2 {
            let is_free = has_ends && plan.shafts[s];
            let wheel = if is_free { self.end(s) } else { s };
            if !is_free {
                ledger_rates.shaft[s] = inputs.load_torque[s];
            }
            if plan.side_imposed[s] {
                let inertial = self.ideal.inertia[wheel] * rates.side_speed[s];
                ledger_rates.input += (inertial - sum[wheel]) * at.v[wheel];
            } else {
                sum[wheel] -= inputs.load_torque[s];
                ledger_rates.input -= inputs.load_torque[s] * at.v[wheel];
            }
        }
        if !plan.drive_imposed {
            let port = self.ideal.layout.port;
            sum[port] += inputs.drive_torque;
            ledger_rates.input += inputs.drive_torque * at.v[port];
        }
        [rates.drive_speed, rates.planet_spin, rates.side_speed[0], rates.side_speed[1]]
    }

    /// Accelerations under inputs.
    pub(super) fn accelerate(&self, at: &Point<N>, now: InputsNow) -> [f64; N] {
        if let Some(linear) = self.linear() {
            let (sum, imposed) = self.forces_of_shafts(linear, at, now, &mut LedgerRates::default());
            return self.accelerations_by_shafts(&sum, &imposed);
        }
        let ledger_rates = &mut LedgerRates::default();
        let (mut sum, imposed) = self.forces(at, now, ledger_rates);
        self.accelerations_with_loss(at, now, (&mut sum, &imposed), ledger_rates)
    }

    /// Accelerations, with the friction of a rigid pinion under the torque of its mesh, which is subtracted from `sum`.
    #[inline]
    fn accelerations_with_loss(
        &self,
        at: &Point<N>,
        now: InputsNow,
        (sum, imposed): (&mut [f64; N], &[f64; IMPOSED]),
        ledger_rates: &mut LedgerRates,
    ) -> [f64; N] {
        let a = self.accelerations(sum, imposed);
        let Some(pinion) = self.sliding_pinion() else { return a };
        let driven = self.driven(at, now, (sum, &a));
        pinion.brake((driven, a[CARRIER], at.v[CARRIER]), sum, ledger_rates);
        self.accelerations(sum, imposed)
    }

    /// Torque in front of a rigid pinion, given all forces and accelerations.
    fn driven(&self, at: &Point<N>, now: InputsNow, (sum, a): (&[f64; N], &[f64; N])) -> f64 {
        let on_pinion = match self.ideal.layout.port {
            CARRIER => self.torques_of(sum, a, now.0.drive_torque).drive,
            _ => 0.0,
        };
        self.torque_in_front(at) + on_pinion
    }

    /// Returns accelerations under inputs and adds to the ledger rates.
    pub(super) fn evaluate_under(&self, at: &Point<N>, now: InputsNow, ledger_rates: &mut LedgerRates) -> [f64; N] {
        let (mut sum, imposed) = match self.linear() {
            Some(linear) => self.forces_of_shafts(linear, at, now, ledger_rates),
            None => self.forces(at, now, ledger_rates),
        };
        let a = self.accelerations_with_loss(at, now, (&mut sum, &imposed), ledger_rates);
        let plan = &self.ideal.plan;
        if plan.drive_imposed || plan.spin_imposed {
            let torques = self.torques_of(&sum, &a, now.0.drive_torque);
            if plan.drive_imposed {
                ledger_rates.input += torques.drive * at.v[self.ideal.layout.port];
            }
            ledger_rates.input += torques.spin * at.v[PLANET];
        }
        a
    }

    /// Writes the linearised equations under inputs to `lin`.
    pub(super) fn linearise_under(&self, at: &Point<N>, now: InputsNow, lin: &mut Linearisation<N, LedgerRates>) {
        lin.ledger_rates = LedgerRates::default();
        lin.acceleration = self.evaluate_under(at, now, &mut lin.ledger_rates);
        if let Some(linear) = self.linear() {
            for i in 0..N {
                lin.by_position[i].copy_from_slice(&linear.by_position[i][..N]);
                lin.by_velocity[i].copy_from_slice(&linear.by_velocity[i][..N]);
            }
            return;
        }
        let (mut by_position, mut by_velocity) = ([[0.0; N]; N], [[0.0; N]; N]);
        let mut out = Slopes::new([&mut by_position, &mut by_velocity]);
        let motion = self.motion(at, now);
        for effect in self.ideal.body_effects.forces.iter() {
            effect.slopes(&motion, &mut out);
        }
        if self.has_dry_friction() {
            let mut by_rate = [[0.0; N]; N];
            let by_velocity = &mut by_velocity;
            let j = &mut Jacobian { by_position: &mut by_position, by_rate: &mut by_rate, by_velocity };
            self.friction_slopes(at, &self.applied.friction().commanded_loads(now.0), j);
            self.times_rates(&mut by_rate);
            for (row, by_rate) in by_velocity.iter_mut().zip(&by_rate) {
                lanes::add_times(row, 1.0, by_rate);
            }
        }
        self.ideal.accelerations_by(&by_position, &mut lin.by_position);
        self.ideal.accelerations_by(&by_velocity, &mut lin.by_velocity);
        // an imposed speed of the carrier does not depend on its friction
        if let Some(pinion) = self.sliding_pinion().filter(SlidingPinion::is_free) {
            let (sum, imposed) = self.forces(at, now, &mut LedgerRates::default());
            let a = self.accelerations(&sum, &imposed);
            let of_drive = self.slopes_in_front(at);
            let slopes = [(&of_drive[0], &lin.by_position[CARRIER]), (&of_drive[1], &lin.by_velocity[CARRIER])];
            let driven = self.driven(at, now, (&sum, &a));
            pinion.brake_slopes((driven, a[CARRIER]), slopes, [&mut by_position, &mut by_velocity]);
            self.ideal.accelerations_by(&by_position, &mut lin.by_position);
            self.ideal.accelerations_by(&by_velocity, &mut lin.by_velocity);
        }
    }

    /// Torques that follow from the constraint. `drive` is the torque of a drive whose speed is not imposed.
    #[inline]
    fn torques_of(&self, sum: &[f64; N], a: &[f64; N], drive: f64) -> IdealTorques {
        let ideal = self.ideal;
        let lack: [f64; N] = std::array::from_fn(|i| ideal.inertia[i] * a[i] - sum[i]);
        let plan = &ideal.plan;
        IdealTorques {
            drive: match (plan.drive_imposed, ideal.layout.port) {
                (false, _) => drive,
                (true, CARRIER) => lack[0] + lack[1] + lack[CARRIER],
                (true, port) => lack[port],
            },
            spin: if plan.spin_imposed { ideal.ratio * (lack[0] - lack[1]) + lack[PLANET] } else { 0.0 },
            gears: [lack[0], lack[1]],
        }
    }

    /// Torques that follow from the constraint.
    pub fn torques(&self, at: &Point<N>) -> IdealTorques {
        self.torques_under(at, self.now())
    }

    fn torques_under(&self, at: &Point<N>, now: InputsNow) -> IdealTorques {
        let mut ledger_rates = LedgerRates::default();
        let (mut sum, imposed) = self.forces(at, now, &mut ledger_rates);
        let a = self.accelerations_with_loss(at, now, (&mut sum, &imposed), &mut ledger_rates);
        self.torques_of(&sum, &a, now.0.drive_torque)
    }

    /// Kinetic energy [J].
    pub(super) fn kinetic_energy(&self, at: &Point<N>) -> f64 {
        // rows beyond the last degree of freedom have no inertia
        0.5 * (0..N).map(|i| self.ideal.inertia[i] * at.v[i] * at.v[i]).sum::<f64>()
    }

    /// Energy stored in half-shafts and stuck friction [J].
    pub(super) fn stored_energy(&self, at: &Point<N>) -> f64 {
        let motion = self.motion(at, self.now());
        if self.linear().is_some() && self.applied.is_free() {
            return self.ideal.body_effects.forces[0].energy(&motion);
        }
        let bodies: f64 = self.ideal.body_effects.forces.iter().map(|e| e.energy(&motion)).sum();
        bodies + self.friction_energy(at)
    }
}

impl<const N: usize> FrictionEquations<N> for IdealEquations<'_, N> {
    fn applied(&self) -> &InputsAndFriction {
        &self.applied
    }

    fn applied_mut(&mut self) -> &mut InputsAndFriction {
        &mut self.applied
    }

    fn body_effects(&self) -> Option<&BodyEffects> {
        Some(&self.ideal.body_effects)
    }

    fn plan(&self) -> &Plan {
        &self.ideal.plan
    }

    fn layout(&self) -> &Layout {
        &self.ideal.layout
    }

    fn has_dry_friction(&self) -> bool {
        self.applied.has_dry_friction
    }

    fn may_have_ends(&self) -> bool {
        self.ideal.layout.has_ends()
    }

    fn mesh_loads(&self, _: &Point<N>) -> [SurfaceLoad; PAIRS] {
        [SurfaceLoad::default(); PAIRS]
    }

    fn acceleration_at(&self, at: &Point<N>, time: f64) -> [f64; N] {
        self.accelerate_at(at, time)
    }

    fn drive_torque(&self, at: &Point<N>, time: f64) -> f64 {
        self.at_time(time, |now| self.torques_under(at, now).drive)
    }

    fn carrier_mobility(&self) -> f64 {
        self.ideal.mobility[CARRIER][CARRIER]
    }

    fn acceleration_by_inputs(&self, at: &Point<N>) -> [f64; N] {
        self.accelerate(at, self.now())
    }
}

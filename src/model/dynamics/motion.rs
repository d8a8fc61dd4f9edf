//! Interface of the equations with tooth contact to an integrator: rates, error weights, energy, kinks and switches.

use std::ops::Range;

use super::dogs::DogEquations;
use super::energy_floor::energy_floor;
use super::ledger_rates::LedgerRates;
use super::shape::{MAX_SIZE, Shape};
use super::{Equations, FrictionEquations, Jacobian, PinionLoss};
use crate::contact::planet::Q;
use crate::integrate::{Imbalance, Linearisation, Matrix, Point, SecondOrder, TimedPoint};
use crate::model::effect_kinds::{Action, Slopes};
use crate::model::scene::{CARRIER, InputDerivatives, Inputs};

/// Approach below which errors of positions are absolute instead of relative [rad on the unit sphere].
const APPROACH_FLOOR: f64 = 1e-4;
/// Largest approach of teeth that an iteration may reach from within the backlash [rad].
const FIRST_APPROACH: f64 = 5e-4;
/// Largest factor by which an iteration may increase an approach of teeth.
const APPROACH_GROWTH: f64 = 4.0;
/// Speed below which errors of velocities are absolute instead of relative [rad/s].
const SPEED_FLOOR: f64 = 1.0;
/// Twist of a half-shaft below which its error is absolute instead of relative [rad].
const TWIST_FLOOR: f64 = 1e-3;

impl<const N: usize, S: Shape<N>> SecondOrder<N> for Equations<'_, S, N> {
    type Rates = LedgerRates;

    #[inline]
    fn degrees_of_freedom(&self) -> usize {
        self.count()
    }

    /// Indices of planets and their pins.
    #[inline]
    fn inner(&self) -> Range<usize> {
        self.planets_and_pins()
    }

    #[inline]
    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        let mut rates = *v;
        for s in 0..2 {
            rates[s] -= v[CARRIER];
        }
        if self.has_pins() {
            for g in 0..self.groups() {
                rates[self.pin(g)] -= v[CARRIER];
            }
        }
        S::set_twist_rates(&self.teeth.layout, v, &mut rates);
        rates
    }

    #[inline]
    fn times_rates(&self, m: &mut Matrix<N>) {
        for row in &mut m[..self.count()] {
            row[CARRIER] -= row[0] + row[1];
            if self.has_pins() {
                row[CARRIER] -= self.sum(|g| row[self.pin(g)]);
            }
        }
        if S::is_attached(&self.teeth.layout) {
            m[..self.count()].iter_mut().for_each(|row| S::turn_twist_rates(&self.teeth.layout, row));
        }
    }

    #[inline]
    fn evaluate(&self, at: &Point<N>) -> ([f64; N], LedgerRates) {
        let mut ledger_rates = LedgerRates::default();
        (self.accelerate(at, &mut ledger_rates), ledger_rates)
    }

    fn linearise(&self, at: &Point<N>) -> Linearisation<N, LedgerRates> {
        let mut lin = Linearisation::default();
        self.linearise_and_store(at, &mut lin);
        lin
    }

    #[inline]
    fn is_driven(&self) -> bool {
        S::MAY_CHANGE && self.driven.changes
    }

    #[inline]
    fn evaluate_at(&self, at: &Point<N>, time: f64) -> ([f64; N], LedgerRates) {
        if self.scales_by_inputs() {
            return self.later(time).evaluate(at);
        }
        let (mut accelerations, mut ledger_rates) = self.evaluate(at);
        self.add_by_inputs(time, &mut accelerations);
        ledger_rates.input += self.added_power(at, time);
        (accelerations, ledger_rates)
    }

    #[inline]
    fn linearise_at(&self, at: &Point<N>, time: f64) -> Linearisation<N, LedgerRates> {
        let mut lin = Linearisation::default();
        self.linearise_with_energy(at, time, &mut lin);
        lin
    }

    #[inline]
    fn accelerate_at(&self, at: &Point<N>, time: f64) -> [f64; N] {
        let ledger_rates = &mut LedgerRates::default();
        if self.scales_by_inputs() {
            return self.later(time).accelerate(at, ledger_rates);
        }
        let mut accelerations = self.accelerate(at, ledger_rates);
        self.add_by_inputs(time, &mut accelerations);
        accelerations
    }

    fn drift(&self, at: &Point<N>, time: f64) -> [f64; N] {
        if self.driven.scales { self.drift_at(at, time) } else { self.driven.slope(time) }
    }

    fn combined(&self, of: [(f64, &LedgerRates); 5]) -> LedgerRates {
        LedgerRates::combined(of)
    }

    #[inline(never)]
    fn undo_torque_change(&self, at: &Point<N>, ledger_rates: &mut LedgerRates) {
        self.undo_input_change(at, ledger_rates);
    }

    #[inline]
    fn weights(&self, at: &Point<N>) -> Point<N> {
        let per_approach = 1.0 / (self.deepest(at).0.max(0.0) + APPROACH_FLOOR);
        let [planet, side] = self.teeth.sin_base.map(|lever| lever * per_approach);
        let mut q = [planet; N];
        (q[0], q[1], q[CARRIER]) = (side, side, 1.0);
        // relative to the rolling speeds: impacts of teeth change the speed of a gear, but not its tolerance
        let carrier = SPEED_FLOOR + 2.0 * at.v[CARRIER].abs();
        let mut spin = 0.0f64;
        for g in 0..self.groups() {
            spin = spin.max(at.v[self.planet(g)].abs());
        }
        let side_speed = 1.0 / (carrier + spin * self.teeth.sin_base[0] / self.teeth.sin_base[1]);
        let mut v = [1.0 / (carrier + spin); N];
        (v[0], v[1], v[CARRIER]) = (side_speed, side_speed, 1.0 / carrier);
        if self.has_pins() {
            let per_length = per_approach / self.teeth.contact.mesh.whole.cone;
            for s in 0..2 {
                q[CARRIER + 1 + s] = per_length;
                v[CARRIER + 1 + s] = v[s] / self.teeth.contact.mesh.whole.cone;
            }
            for g in 0..self.groups() {
                (q[self.pin(g)], v[self.pin(g)]) = (side, v[CARRIER]);
            }
        }
        let attached = self.teeth.layout.attached().take(if S::is_attached(&self.teeth.layout) { N } else { 0 });
        for (k, (i, to)) in attached.enumerate() {
            let twist = at.q[i] - self.applied.dogs.middle(k);
            (q[i], v[i]) = (1.0 / (TWIST_FLOOR + twist.abs()), v[to]);
        }
        Point { q, v }
    }

    #[inline]
    fn energy(&self, at: &Point<N>) -> [f64; 2] {
        [self.kinetic_energy(at), self.stored_energy(at, true)]
    }

    #[inline]
    fn linearise_with_energy(&self, at: &Point<N>, time: f64, lin: &mut Linearisation<N, LedgerRates>) -> [f64; 2] {
        let teeth = if self.scales_by_inputs() {
            self.later(time).linearise_and_store(at, lin)
        } else {
            self.linearise_and_store(at, lin)
        };
        self.add_by_inputs(time, &mut lin.acceleration);
        lin.ledger_rates.input += self.added_power(at, time);
        [self.kinetic_energy(at), teeth + self.stored_energy_of_bodies(at, true)]
    }

    #[inline]
    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, ledger_rates: &[LedgerRates; 3]) -> Imbalance {
        // pairs that enter and leave contact abruptly change the energy without work of a force
        if !self.teeth.contact.mesh.engagement.corner_contact() {
            return Imbalance::NONE;
        }
        if S::MAY_ACT {
            LedgerRates::imbalance::<true>(energies, h, ledger_rates)
        } else {
            LedgerRates::imbalance::<false>(energies, h, ledger_rates)
        }
    }

    #[inline(never)]
    fn energy_floor(&self, ends: [&Point<N>; 2], tolerance: f64, residual: f64) -> f64 {
        let spring_forces = || {
            let free = self.largest().under(&Inputs::ZERO, &InputDerivatives::ZERO);
            let rest = Point::of([&ends[1].q, &[0.0; N]]);
            let mut sum = [0.0; MAX_SIZE];
            free.act(&rest, &mut sum, &mut LedgerRates::default());
            std::array::from_fn(|i| sum[i])
        };
        let is_apart = ends.iter().all(|at| self.deepest(at).0 <= 0.0);
        energy_floor(self, ends, (tolerance, is_apart), residual, spring_forces, |at| self.kinetic_energy(at))
    }

    fn safe_fraction(&self, from: &Point<N>, to: &Point<N>) -> f64 {
        let mut fraction = 1.0f64;
        for g in 0..self.groups() {
            for s in 0..2 {
                let [from, to] = [from, to].map(|at| self.mesh_state(at, g, s).position[Q]);
                let most = self.teeth.contact.mesh.half_backlash()
                    + f64::max(FIRST_APPROACH, APPROACH_GROWTH * self.teeth.contact.mesh.approach(from));
                if to.abs() > most {
                    fraction = fraction.min((most.copysign(to) - from) / (to - from));
                }
            }
        }
        fraction
    }

    #[inline]
    fn kink(&self, at: &Point<N>, h: f64) -> Option<f64> {
        self.first_kink(at, h)
    }

    #[inline]
    fn crossing(&self, start: TimedPoint<N>, end: TimedPoint<N>) -> Option<f64> {
        if S::MAY_ACT { self.switch_crossing(start, end) } else { None }
    }
}

impl<const N: usize, S: Shape<N>> Equations<'_, S, N> {
    /// Returns the accelerations and completes the ledger rates.
    #[inline]
    pub(super) fn accelerate(&self, at: &Point<N>, ledger_rates: &mut LedgerRates) -> [f64; N] {
        let mut sum = [0.0; N];
        self.act(at, &mut sum, ledger_rates);
        // a small copy stays in registers
        let mut sum = if S::HAS_OWN_STEPS { std::array::from_fn(|i| sum[i]) } else { sum };
        self.finish(at, &mut sum, ledger_rates);
        sum
    }

    /// Adds all forces except commanded torques.
    #[inline]
    pub(in crate::model) fn act(&self, at: &Point<N>, sum: &mut [f64; N], ledger_rates: &mut LedgerRates) {
        self.add_mesh_forces(at, sum, ledger_rates);
        if S::MAY_ACT {
            self.act_on_bodies(at, sum, ledger_rates);
        }
    }

    /// Adds the forces of the effects on bodies.
    pub(in crate::model) fn act_on_bodies(&self, at: &Point<N>, sum: &mut [f64; N], ledger_rates: &mut LedgerRates) {
        let motion = self.body_motion(at);
        let mut out = Action { force: sum, heat: &mut ledger_rates.heat };
        for effect in self.teeth.effect_terms.body_effects.forces.iter() {
            effect.act(&motion, &mut out);
        }
        if self.may_have_ends() {
            ledger_rates.shaft = [0, 1].map(|s| self.shaft_torque(at, s));
        }
    }

    /// Torque that the half-shaft of side `s` delivers to the wheel [N·m]. It is the load torque if the shaft has no
    /// degree of freedom.
    pub(in crate::model) fn shaft_torque(&self, at: &Point<N>, s: usize) -> f64 {
        if !self.may_have_ends() || !self.teeth.plan.shafts[s] {
            return self.applied.inputs.load_torque[s];
        }
        let end = self.end(s);
        let motion = [at.q[end], at.v[s] - at.v[end]];
        self.teeth.effect_terms.body_effects.half_shafts.torque(s, motion, &self.applied.dogs)
    }

    /// Adds the torques of inputs, converts sums of forces to accelerations, and completes the ledger rates.
    #[inline(always)]
    pub(in crate::model) fn finish(&self, at: &Point<N>, sum: &mut [f64; N], ledger_rates: &mut LedgerRates) {
        let (plan, inverse) = (&self.teeth.plan, &self.teeth.inverse_inertia);
        let rates = &self.applied.input_derivatives.rates[0];
        let mut input = 0.0;
        for s in 0..2 {
            let wheel = if S::MAY_ACT { self.wheel(s) } else { s };
            if S::MAY_ACT && plan.side_imposed[s] {
                input += (self.teeth.inertia[wheel] * rates.side_speed[s] - sum[wheel]) * at.v[wheel];
            } else {
                sum[wheel] -= self.applied.inputs.load_torque[s];
                input -= self.applied.inputs.load_torque[s] * at.v[wheel];
            }
        }
        if S::MAY_ACT && self.teeth.effect_terms.body_effects.loss.is_some() {
            self.brake_pinion(at, sum, ledger_rates);
        }
        let (port, drive) = (self.port(), self.drive_under(sum));
        input += drive * at.v[port];
        sum[port] += drive;
        if plan.spin_imposed {
            let inertial = if S::MAY_ACT { self.teeth.inertia[self.planet(0)] * rates.planet_spin } else { 0.0 };
            input -= self.sum(|g| self.members(g) * (sum[self.planet(g)] - inertial) * at.v[self.planet(g)]);
        }
        for (sum, inverse) in sum.iter_mut().zip(inverse) {
            *sum *= inverse;
        }
        if S::MAY_ACT && self.applied.driven {
            if plan.drive_imposed {
                sum[port] = rates.drive_speed;
            }
            for g in (0..self.groups()).filter(|_| plan.spin_imposed) {
                sum[self.planet(g)] = rates.planet_spin;
            }
            for s in (0..2).filter(|&s| plan.side_imposed[s]) {
                sum[self.end(s)] = rates.side_speed[s];
            }
        }
        ledger_rates.input += input;
    }

    /// Torque of the drive, given the `sum` of all other torques. Only an imposed speed depends on them.
    #[inline(always)]
    pub(in crate::model) fn drive_under(&self, sum: &[f64; N]) -> f64 {
        let (port, rates) = (self.port(), &self.applied.input_derivatives.rates[0]);
        let imposed = if S::MAY_ACT { rates.drive_speed } else { 0.0 };
        if self.teeth.plan.drive_imposed {
            self.teeth.inertia[port] * imposed - sum[port]
        } else {
            self.applied.inputs.drive_torque
        }
    }

    /// Subtracts the friction of a rigid pinion under the torque of its mesh.
    #[inline(never)]
    pub(in crate::model) fn brake_pinion(&self, at: &Point<N>, sum: &mut [f64; N], ledger_rates: &mut LedgerRates) {
        if let Some(pinion) = self.sliding_pinion() {
            let of = self.driven_carrier(at, sum);
            pinion.brake((of[0], of[1], at.v[CARRIER]), sum, ledger_rates);
        }
    }

    /// Torque in front of a rigid pinion, and the acceleration of the carrier without friction under the torque of the
    /// mesh, given the `sum` of all torques but that of the drive.
    fn driven_carrier(&self, at: &Point<N>, sum: &[f64; N]) -> [f64; 2] {
        let (in_front, inertia) = (self.torque_in_front(at), self.teeth.inertia[CARRIER]);
        let inputs = &self.applied;
        match (self.port() == CARRIER, self.teeth.plan.drive_imposed) {
            (true, true) => {
                let acceleration = inputs.input_derivatives.rates[0].drive_speed;
                [in_front + inertia * acceleration - sum[CARRIER], acceleration]
            }
            (true, false) => {
                [in_front + inputs.inputs.drive_torque, (sum[CARRIER] + inputs.inputs.drive_torque) / inertia]
            }
            (false, _) => [in_front, sum[CARRIER] / inertia],
        }
    }

    /// Adds the derivatives of the friction of a rigid pinion under the torque of its mesh, given those of all forces.
    #[inline(never)]
    fn brake_pinion_slopes(&self, at: &Point<N>, sum: &[f64; N], [by_position, by_velocity]: [&mut Matrix<N>; 2]) {
        let Some(pinion) = self.sliding_pinion() else { return };
        let (of, inverse) = (self.driven_carrier(at, sum), self.teeth.inverse_inertia[CARRIER]);
        let [driven_by_position, driven_by_velocity] = self.slopes_in_front(at);
        let [a, b] = [&*by_position, &*by_velocity].map(|matrix| matrix[CARRIER].map(|torque| inverse * torque));
        let slopes = [(&driven_by_position, &a), (&driven_by_velocity, &b)];
        pinion.brake_slopes((of[0], of[1]), slopes, [by_position, by_velocity]);
    }

    /// Writes the linearised equations to `lin`. Returns the elastic energy of all meshes [J].
    #[inline]
    pub(in crate::model) fn linearise_and_store(&self, at: &Point<N>, lin: &mut Linearisation<N, LedgerRates>) -> f64 {
        (lin.acceleration, lin.ledger_rates) = ([0.0; N], LedgerRates::default());
        // rows beyond the last degree of freedom are always zero
        for i in 0..self.count() {
            (lin.by_position[i], lin.by_velocity[i]) = ([0.0; N], [0.0; N]);
        }
        if S::MAY_ACT { self.linearise_all(at, lin) } else { self.linearise_teeth(at, lin) }
    }

    /// Adds the linearised equations of teeth without effects to `lin`. Returns the elastic energy of all meshes [J].
    #[inline]
    fn linearise_teeth(&self, at: &Point<N>, lin: &mut Linearisation<N, LedgerRates>) -> f64 {
        let Linearisation { acceleration, by_position, by_velocity, ledger_rates } = lin;
        let mut unused = [[0.0; N]; N];
        let mut j = Jacobian { by_position, by_rate: by_velocity, by_velocity: &mut unused };
        let energy = self.linearise_contact(at, acceleration, ledger_rates, &mut j);
        // α̇ = ω_s − ω_c
        self.times_rates(j.by_rate);
        self.divide_by_inertia(j.by_position);
        self.divide_by_inertia(j.by_rate);
        self.finish(at, acceleration, ledger_rates);
        energy
    }

    /// Adds the linearised equations with all effects to `lin`. Returns the elastic energy of all meshes [J].
    #[inline]
    fn linearise_all(&self, at: &Point<N>, lin: &mut Linearisation<N, LedgerRates>) -> f64 {
        let Linearisation { acceleration, by_position, by_velocity, ledger_rates } = lin;
        let mut by_rate = [[0.0; N]; N];
        let j = &mut Jacobian { by_position: &mut *by_position, by_rate: &mut by_rate, by_velocity: &mut *by_velocity };
        let energy = self.linearise_contact(at, acceleration, ledger_rates, j);
        self.act_on_bodies(at, acceleration, ledger_rates);
        let mut out = Slopes::new([&mut *by_position, &mut *by_velocity]);
        for effect in self.teeth.effect_terms.body_effects.forces.iter() {
            effect.slopes(&self.body_motion(at), &mut out);
        }
        self.times_rates(&mut by_rate);
        for i in 0..self.count() {
            for j in 0..N {
                by_velocity[i][j] += by_rate[i][j];
            }
        }
        if self.teeth.effect_terms.body_effects.loss.is_some() {
            self.brake_pinion_slopes(at, acceleration, [&mut *by_position, &mut *by_velocity]);
        }
        self.divide_by_inertia(by_position);
        self.divide_by_inertia(by_velocity);
        self.finish(at, acceleration, ledger_rates);
        energy
    }

    fn divide_by_inertia(&self, m: &mut Matrix<N>) {
        for (row, inverse) in m[..self.count()].iter_mut().zip(&self.teeth.inverse_inertia) {
            row.iter_mut().for_each(|x| *x *= inverse);
        }
    }
}

//! Interface of the equations with tooth contact to an integrator: rates, error weights, energy, kinks and switches.

use std::ops::Range;

use super::dogs::DogEquations;
use super::energy_floor::energy_floor;
use super::ledger_rates::LedgerRates;
use super::shape::{MAX_SIZE, Shape};
use super::{Equations, FrictionEquations};
use crate::contact::planet::Q;
use crate::integrate::{Imbalance, Linearisation, Matrix, Point, SecondOrder, TimedPoint};
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

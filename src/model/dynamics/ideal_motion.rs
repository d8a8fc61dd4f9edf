//! Interface of the equations of ideal gears to an integrator.

use super::dogs::DogEquations;
use super::energy_floor::energy_floor;
use super::ledger_rates::LedgerRates;
use super::shape::{set_twist_rates, turn_twist_rates};
use super::{FrictionEquations, IdealEquations};
use crate::integrate::{Imbalance, Linearisation, Matrix, Point, SecondOrder, TimedPoint};
use crate::model::scene::{CARRIER, Inputs, PLANET};

impl<const N: usize> SecondOrder<N> for IdealEquations<'_, N> {
    type Rates = LedgerRates;

    fn degrees_of_freedom(&self) -> usize {
        self.ideal.layout.count()
    }

    #[inline]
    fn rows(&self) -> usize {
        N
    }

    fn energy(&self, at: &Point<N>) -> [f64; 2] {
        [self.kinetic_energy(at), self.stored_energy(at)]
    }

    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, ledger_rates: &[LedgerRates; 3]) -> Imbalance {
        LedgerRates::imbalance::<true>(energies, h, ledger_rates)
    }

    fn energy_floor(&self, ends: [&Point<N>; 2], tolerance: f64, residual: f64) -> f64 {
        let spring_forces = || {
            let rest = Point { q: ends[1].q, v: [0.0; N] };
            let (force, _) = self.forces(&rest, (&Inputs::ZERO, &Inputs::ZERO), &mut LedgerRates::default());
            std::array::from_fn(|i| force.get(i).copied().unwrap_or(0.0))
        };
        energy_floor(self, ends, (tolerance, false), residual, spring_forces, |at| self.kinetic_energy(at))
    }

    #[inline]
    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        let mut rates = *v;
        for s in 0..2 {
            rates[s] -= v[CARRIER];
        }
        // constant indices of the ends need no tests
        for s in (0..2).filter(|_| self.may_have_ends()) {
            rates[self.end(s)] = v[s] - v[self.end(s)];
        }
        set_twist_rates(self.ideal.others.iter().copied(), v, &mut rates);
        rates
    }

    #[inline]
    fn times_rates(&self, m: &mut Matrix<N>) {
        let has_ends = self.may_have_ends();
        for row in m.iter_mut() {
            row[CARRIER] -= row[0] + row[1];
            for s in (0..2).filter(|_| has_ends) {
                let end = self.end(s);
                row[s] += row[end];
                row[end] = -row[end];
            }
            turn_twist_rates(self.ideal.others.iter().copied(), row);
        }
    }

    fn evaluate(&self, at: &Point<N>) -> ([f64; N], LedgerRates) {
        let mut ledger_rates = LedgerRates::default();
        (self.evaluate_under(at, self.now(), &mut ledger_rates), ledger_rates)
    }

    fn linearise(&self, at: &Point<N>) -> Linearisation<N, LedgerRates> {
        let mut lin = Linearisation::default();
        self.linearise_under(at, self.now(), &mut lin);
        lin
    }

    #[inline]
    fn is_driven(&self) -> bool {
        self.applied.driven
    }

    #[inline]
    fn evaluate_at(&self, at: &Point<N>, time: f64) -> ([f64; N], LedgerRates) {
        let mut ledger_rates = LedgerRates::default();
        (self.at_time(time, |now| self.evaluate_under(at, now, &mut ledger_rates)), ledger_rates)
    }

    #[inline]
    fn accelerate_at(&self, at: &Point<N>, time: f64) -> [f64; N] {
        self.at_time(time, |now| self.accelerate(at, now))
    }

    fn linearise_at(&self, at: &Point<N>, time: f64) -> Linearisation<N, LedgerRates> {
        let mut lin = Linearisation::default();
        self.at_time(time, |now| self.linearise_under(at, now, &mut lin));
        lin
    }

    #[inline]
    fn linearise_with_energy(&self, at: &Point<N>, time: f64, lin: &mut Linearisation<N, LedgerRates>) -> [f64; 2] {
        self.at_time(time, |now| self.linearise_under(at, now, lin));
        self.energy(at)
    }

    fn drift(&self, at: &Point<N>, time: f64) -> [f64; N] {
        self.drift_at(at, time)
    }

    fn combined(&self, of: [(f64, &LedgerRates); 5]) -> LedgerRates {
        LedgerRates::combined(of)
    }

    fn undo_torque_change(&self, at: &Point<N>, ledger_rates: &mut LedgerRates) {
        self.undo_input_change(at, ledger_rates);
        for s in (0..2).filter(|&s| !(self.may_have_ends() && self.ideal.plan.shafts[s])) {
            ledger_rates.shaft[s] = self.applied.inputs.load_torque[s] - self.applied.change[s];
        }
    }

    fn weights(&self, at: &Point<N>) -> Point<N> {
        let carrier = 1.0 + 2.0 * at.v[CARRIER].abs();
        let mut weights = Point { q: [1.0; N], v: [1.0 / (carrier + at.v[PLANET].abs()); N] };
        if self.has_dry_friction() {
            // a stuck clutch or wheel turns by milliradians
            (weights.q[0], weights.q[1]) = (1e3, 1e3);
        }
        for (k, (i, _)) in self.ideal.layout.attached().enumerate() {
            weights.q[i] = 1.0 / (1e-3 + (at.q[i] - self.applied.dogs.middle(k)).abs());
        }
        weights
    }

    fn kink(&self, at: &Point<N>, h: f64) -> Option<f64> {
        self.kink_of_effects(at, h)
    }

    fn crossing(&self, start: TimedPoint<N>, end: TimedPoint<N>) -> Option<f64> {
        self.switch_crossing(start, end)
    }
}

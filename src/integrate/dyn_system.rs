//! A system behind a table of functions: methods other than the default one are compiled once per size, not once per kind
//! of equations. A call through the table costs some nanoseconds, a hundredth of the called function.

use super::system::{Linearisation, Matrix, Point, SecondOrder};

/// The functions of a [`SecondOrder`] system that can be called through a table.
pub trait DynSecondOrder<const N: usize, P> {
    /// See [`SecondOrder::rates`].
    fn rates(&self, v: &[f64; N]) -> [f64; N];
    /// See [`SecondOrder::times_rates`].
    fn times_rates(&self, m: &mut Matrix<N>);
    /// See [`SecondOrder::evaluate`].
    fn evaluate(&self, at: &Point<N>) -> ([f64; N], P);
    /// See [`SecondOrder::linearise`].
    fn linearise(&self, at: &Point<N>) -> Linearisation<N, P>;
    /// See [`SecondOrder::is_driven`].
    fn is_driven(&self) -> bool;
    /// See [`SecondOrder::evaluate_at`].
    fn evaluate_at(&self, at: &Point<N>, time: f64) -> ([f64; N], P);
    /// See [`SecondOrder::linearise_at`].
    fn linearise_at(&self, at: &Point<N>, time: f64) -> Linearisation<N, P>;
    /// See [`SecondOrder::drift`].
    fn drift(&self, at: &Point<N>, time: f64) -> [f64; N];
    /// See [`SecondOrder::weights`].
    fn weights(&self, at: &Point<N>) -> Point<N>;
    /// See [`SecondOrder::energy`].
    fn energy(&self, at: &Point<N>) -> [f64; 2];
    /// See [`SecondOrder::linearise_with_energy`].
    fn linearise_with_energy(&self, at: &Point<N>, time: f64) -> (Linearisation<N, P>, [f64; 2]);
    /// See [`SecondOrder::imbalance`].
    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, power: &[P; 3]) -> f64;
    /// See [`SecondOrder::reach`].
    fn reach(&self, from: &Point<N>, to: &Point<N>) -> f64;
    /// See [`SecondOrder::kink`].
    fn kink(&self, at: &Point<N>, h: f64) -> Option<f64>;
    /// See [`SecondOrder::crossing`].
    fn crossing(&self, start: (&Point<N>, f64), end: (&Point<N>, f64)) -> Option<f64>;
}

impl<const N: usize, S: SecondOrder<N>> DynSecondOrder<N, S::Power> for S {
    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        SecondOrder::rates(self, v)
    }
    fn times_rates(&self, m: &mut Matrix<N>) {
        SecondOrder::times_rates(self, m);
    }
    fn evaluate(&self, at: &Point<N>) -> ([f64; N], S::Power) {
        SecondOrder::evaluate(self, at)
    }
    fn linearise(&self, at: &Point<N>) -> Linearisation<N, S::Power> {
        SecondOrder::linearise(self, at)
    }
    fn is_driven(&self) -> bool {
        SecondOrder::is_driven(self)
    }
    fn evaluate_at(&self, at: &Point<N>, time: f64) -> ([f64; N], S::Power) {
        SecondOrder::evaluate_at(self, at, time)
    }
    fn linearise_at(&self, at: &Point<N>, time: f64) -> Linearisation<N, S::Power> {
        SecondOrder::linearise_at(self, at, time)
    }
    fn drift(&self, at: &Point<N>, time: f64) -> [f64; N] {
        SecondOrder::drift(self, at, time)
    }
    fn weights(&self, at: &Point<N>) -> Point<N> {
        SecondOrder::weights(self, at)
    }
    fn energy(&self, at: &Point<N>) -> [f64; 2] {
        SecondOrder::energy(self, at)
    }
    fn linearise_with_energy(&self, at: &Point<N>, time: f64) -> (Linearisation<N, S::Power>, [f64; 2]) {
        SecondOrder::linearise_with_energy(self, at, time)
    }
    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, power: &[S::Power; 3]) -> f64 {
        SecondOrder::imbalance(self, energies, h, power)
    }
    fn reach(&self, from: &Point<N>, to: &Point<N>) -> f64 {
        SecondOrder::reach(self, from, to)
    }
    fn kink(&self, at: &Point<N>, h: f64) -> Option<f64> {
        SecondOrder::kink(self, at, h)
    }
    fn crossing(&self, start: (&Point<N>, f64), end: (&Point<N>, f64)) -> Option<f64> {
        SecondOrder::crossing(self, start, end)
    }
}

/// A system whose kind is not known at compile time.
pub struct DynSystem<'a, const N: usize, P>(pub &'a dyn DynSecondOrder<N, P>);

impl<const N: usize, P: Copy> SecondOrder<N> for DynSystem<'_, N, P> {
    type Power = P;

    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        self.0.rates(v)
    }
    fn times_rates(&self, m: &mut Matrix<N>) {
        self.0.times_rates(m);
    }
    fn evaluate(&self, at: &Point<N>) -> ([f64; N], P) {
        self.0.evaluate(at)
    }
    fn linearise(&self, at: &Point<N>) -> Linearisation<N, P> {
        self.0.linearise(at)
    }
    fn is_driven(&self) -> bool {
        self.0.is_driven()
    }
    fn evaluate_at(&self, at: &Point<N>, time: f64) -> ([f64; N], P) {
        self.0.evaluate_at(at, time)
    }
    fn linearise_at(&self, at: &Point<N>, time: f64) -> Linearisation<N, P> {
        self.0.linearise_at(at, time)
    }
    fn drift(&self, at: &Point<N>, time: f64) -> [f64; N] {
        self.0.drift(at, time)
    }
    fn weights(&self, at: &Point<N>) -> Point<N> {
        self.0.weights(at)
    }
    fn energy(&self, at: &Point<N>) -> [f64; 2] {
        self.0.energy(at)
    }
    fn linearise_with_energy(&self, at: &Point<N>, time: f64) -> (Linearisation<N, P>, [f64; 2]) {
        self.0.linearise_with_energy(at, time)
    }
    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, power: &[P; 3]) -> f64 {
        self.0.imbalance(energies, h, power)
    }
    fn reach(&self, from: &Point<N>, to: &Point<N>) -> f64 {
        self.0.reach(from, to)
    }
    fn kink(&self, at: &Point<N>, h: f64) -> Option<f64> {
        self.0.kink(at, h)
    }
    fn crossing(&self, start: (&Point<N>, f64), end: (&Point<N>, f64)) -> Option<f64> {
        self.0.crossing(start, end)
    }
}

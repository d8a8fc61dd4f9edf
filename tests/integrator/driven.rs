//! Tests of systems whose accelerations depend on time. They must be as accurate as systems with time as a degree of
//! freedom.

use std::cell::Cell;

use bevel_differential::integrate::{Control, Linearisation, Point, SecondOrder, SolverContext, Statistics, Step};

use super::follow::{AfterStep, advance, advance_fixed};
use super::methods::{Known, step_from, with_every_method};
use super::problems::{forced, forced_exact};

with_every_method!(
    a_driven_system_moves_like_a_system_with_time_as_a_degree_of_freedom
    the_driver_passes_the_time_to_the_system
);

/// The problem `forced` with time itself in place of its clock. It counts its evaluations.
struct Driven {
    lambda: f64,
    evaluations: Cell<u64>,
}

impl Driven {
    fn new(lambda: f64) -> Self {
        Self { lambda, evaluations: Cell::new(0) }
    }

    fn with_clock(at: &Point<1>, time: f64) -> Point<2> {
        Point { q: [at.q[0], time], v: [at.v[0], 1.0] }
    }
}

impl SecondOrder<1> for Driven {
    type Rates = ();

    fn evaluate(&self, at: &Point<1>) -> ([f64; 1], ()) {
        self.evaluate_at(at, 0.0)
    }
    fn linearise(&self, at: &Point<1>) -> Linearisation<1, ()> {
        self.linearise_at(at, 0.0)
    }
    fn is_driven(&self) -> bool {
        true
    }
    fn evaluate_at(&self, at: &Point<1>, time: f64) -> ([f64; 1], ()) {
        self.evaluations.set(self.evaluations.get() + 1);
        ([forced(self.lambda).evaluate(&Self::with_clock(at, time)).0[0]], ())
    }
    fn linearise_at(&self, at: &Point<1>, time: f64) -> Linearisation<1, ()> {
        self.evaluations.set(self.evaluations.get() + 1);
        let lin = forced(self.lambda).linearise(&Self::with_clock(at, time));
        let (by_position, by_velocity) = ([[lin.by_position[0][0]]], [[lin.by_velocity[0][0]]]);
        Linearisation { acceleration: [lin.acceleration[0]], by_position, by_velocity, ledger_rates: () }
    }
    fn drift(&self, at: &Point<1>, time: f64) -> [f64; 1] {
        [forced(self.lambda).linearise(&Self::with_clock(at, time)).by_position[0][1]]
    }
    fn weights(&self, _: &Point<1>) -> Point<1> {
        Point { q: [1.0], v: [1.0] }
    }
}

fn a_driven_system_moves_like_a_system_with_time_as_a_degree_of_freedom<M: Known>() {
    let lambda = 1e3;
    let (mut clock, mut driven, mut time) = (forced_exact(0.0), Point { q: [0.0], v: [1.0] }, 0.0);
    for h in [0.05, 0.11, 0.02, 0.17] {
        let with_clock = step_from::<M, 2, _>(&forced(lambda), (&clock, 0.0), h);
        let without = step_from::<M, 1, _>(&Driven::new(lambda), (&driven, time), h);
        let (two, one) = (&with_clock.extension, &without.extension);
        for (a, b) in [(two.end, one.end), (two.at(0.3), one.at(0.3)), (with_clock.error, without.error)] {
            let off = (a.q[0] - b.q[0]).abs().max((a.v[0] - b.v[0]).abs());
            // iterations within a step of Radau stop at 1e-11
            assert!(off < 1e-10, "{h}: {off:e}");
        }
        (clock, driven, time) = (two.end, one.end, time + h);
    }
}

fn the_driver_passes_the_time_to_the_system<M: Known>() {
    let (mut point, mut time) = (Point { q: [0.0], v: [1.0] }, 0.0);
    let (mut control, mut statistics, mut budget) = (Control::new(1e-3), Statistics::default(), 1_000_000);
    for until in [0.3, 0.31, 1.0] {
        let context =
            SolverContext { tolerance: 1e-9, control: &mut control, statistics: &mut statistics, budget: &mut budget };
        let proceed = |_: Step<1, ()>| AfterStep::Continue;
        advance(&M::METHOD, &Driven::new(50.0), &mut point, &mut time, until, context, proceed).unwrap();
    }
    assert!((point.v[0] - 1f64.cos()).abs() < 1e-7, "{:e}", point.v[0] - 1f64.cos());
}

#[test]
fn steps_of_fixed_size_keep_their_order_when_driven() {
    let error = |step: f64| {
        let (mut point, mut time) = (Point { q: [0.0], v: [1.0] }, 0.0);
        let (mut statistics, mut budget) = (Statistics::default(), 1_000_000);
        let counts = (&mut statistics, &mut budget);
        advance_fixed(&Driven::new(5.0), &mut point, &mut time, 1.0, step, counts).unwrap();
        (point.v[0] - 1f64.cos()).abs()
    };
    let order = (error(0.01) / error(0.005)).log2();
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

#[test]
fn steps_of_fixed_size_count_their_evaluations() {
    let system = Driven::new(5.0);
    let (mut point, mut time) = (Point { q: [0.0], v: [1.0] }, 0.0);
    let (mut statistics, mut budget) = (Statistics::default(), 1_000_000);
    let counts = (&mut statistics, &mut budget);
    advance_fixed(&system, &mut point, &mut time, 1.0, 0.01, counts).unwrap();
    assert_eq!((statistics.accepted, statistics.evaluations), (100, system.evaluations.get()));
}

//! Tests that steps grow while motion decays to rest, because the energy ledger of a step has a floor.
//!
//! The test is a damped oscillator z″ = −ω²z − 2ζωz′ about a position far from zero. Rounding of the position moves the
//! spring and changes its energy without the work of a force.

use bevel_differential::integrate::{
    Control, Imbalance, Linearisation, POSITION_ROUNDING, Point, SecondOrder, SolverContext, Statistics,
};

use super::follow::{AfterStep, advance};
use super::methods::{Known, with_every_method};

with_every_method!(steps_grow_when_an_oscillator_far_from_zero_comes_to_rest a_remaining_imbalance_does_not_keep_steps_short);

/// Position of rest [rad].
const FAR: f64 = 1e4;
/// Natural frequency [rad/s] and damping ratio.
const OMEGA: f64 = 100.0;
const DAMPING: f64 = 0.2;
/// Tolerance of the integration.
const TOLERANCE: f64 = 1e-6;
/// Budget of attempts. A run with a floor needs a few hundred.
const BUDGET: u64 = 20_000;

/// The oscillator, with unit inertia.
struct Far {
    /// True if the ledger has a floor.
    has_floor: bool,
    /// Energy missing from the ledger of each step, relative to the energy exchanged.
    missing: f64,
}

impl Far {
    fn force(at: &Point<1>) -> f64 {
        -OMEGA * OMEGA * (at.q[0] - FAR)
    }

    /// Exact twist and speed at time `t` [s] after a start at rest at twist 1.
    fn exact(t: f64) -> [f64; 2] {
        let decay = DAMPING * OMEGA;
        let ring = OMEGA * (1.0 - DAMPING * DAMPING).sqrt();
        let (sin, cos) = (ring * t).sin_cos();
        let shrink = (-decay * t).exp();
        [shrink * (cos + decay / ring * sin), -shrink * OMEGA * OMEGA / ring * sin]
    }
}

impl SecondOrder<1> for Far {
    /// Heat of the damping [W].
    type Rates = f64;

    fn evaluate(&self, at: &Point<1>) -> ([f64; 1], f64) {
        let damping = 2.0 * DAMPING * OMEGA * at.v[0];
        ([Self::force(at) - damping], damping * at.v[0])
    }

    fn linearise(&self, at: &Point<1>) -> Linearisation<1, f64> {
        let (acceleration, ledger_rates) = self.evaluate(at);
        let (by_position, by_velocity) = ([[-OMEGA * OMEGA]], [[-2.0 * DAMPING * OMEGA]]);
        Linearisation { acceleration, by_position, by_velocity, ledger_rates }
    }

    fn weights(&self, _: &Point<1>) -> Point<1> {
        Point { q: [1.0], v: [1.0 / OMEGA] }
    }

    fn energy(&self, at: &Point<1>) -> [f64; 2] {
        let z = at.q[0] - FAR;
        [0.5 * at.v[0] * at.v[0], 0.5 * OMEGA * OMEGA * z * z]
    }

    fn imbalance(&self, [before, after]: [[f64; 2]; 2], h: f64, [a, m, b]: &[f64; 3]) -> Imbalance {
        let heat = h / 6.0 * (a + 4.0 * m + b);
        let gained = (after[0] - before[0]) + (after[1] - before[1]);
        let exchanged = before[1].max(after[1]) + heat;
        Imbalance { residual: (gained + heat).abs() + self.missing * exchanged, exchanged }
    }

    /// Energy due to rounding of the position, and energy of the speed that the error norm does not resolve.
    fn energy_floor(&self, [start, end]: [&Point<1>; 2], tolerance: f64, _: f64) -> f64 {
        let rounding = POSITION_ROUNDING * FAR;
        let shifted = (Self::force(start).abs() + Self::force(end).abs()) * rounding;
        let unresolved = tolerance * OMEGA;
        if self.has_floor { shifted + 0.5 * unresolved * unresolved } else { 0.0 }
    }
}

/// Time after which the twist is below 1000 times the rounding of the position [s].
const NEAR_REST: f64 = 1.1;
/// End of a run [s].
const END: f64 = 1000.0;

/// Result of a run.
struct Outcome {
    statistics: Statistics,
    /// Number of attempts near rest whose ledger did not close.
    unbalanced_near_rest: u64,
    /// Size of the longest step [s].
    longest: f64,
}

/// Runs the oscillator to the end, and compares its motion with the exact one.
fn run<M: Known>(system: &Far) -> Outcome {
    let mut point = Point { q: [FAR + 1.0], v: [0.0] };
    let (mut time, mut statistics, mut longest) = (0.0, Statistics::default(), 0.0f64);
    let (control, mut budget) = (&mut Control::new(1e-3), BUDGET);
    let mut integrate = |until: f64, statistics: &mut Statistics| {
        let context = SolverContext { tolerance: TOLERANCE, control: &mut *control, statistics, budget: &mut budget };
        advance(&M::METHOD, system, &mut point, &mut time, until, context, |step| {
            let [z, v] = Far::exact(step.time);
            // each of some hundred steps adds an error within the tolerance
            let [twist, speed] = [step.end.q[0] - FAR - z, (step.end.v[0] - v) / OMEGA];
            assert!(twist.abs().max(speed.abs()) < 1e-4, "errors {twist} and {speed} at {} s", step.time);
            longest = longest.max(step.h);
            AfterStep::Continue
        })
        .unwrap();
    };
    integrate(NEAR_REST, &mut statistics);
    let before = statistics.rejected_ledger;
    integrate(END, &mut statistics);
    Outcome { statistics, unbalanced_near_rest: statistics.rejected_ledger - before, longest }
}

fn steps_grow_when_an_oscillator_far_from_zero_comes_to_rest<M: Known>() {
    let [with, without] = [true, false].map(|has_floor| run::<M>(&Far { has_floor, missing: 0.0 }));
    println!(
        "{:?}, longest step {} s, {} and {} near rest",
        with.statistics, with.longest, with.unbalanced_near_rest, without.unbalanced_near_rest
    );
    // the twist falls to the rounding of the position, 1e-12, within 22 periods
    assert!(with.statistics.accepted < 22 * 50, "{:?}", with.statistics);
    assert!(with.longest > 0.1 * END, "the longest step is {} s", with.longest);
    // without the floor, the ledger resolves a motion that neither the error norm nor the position resolves
    assert_eq!(with.unbalanced_near_rest, 0);
    assert!(without.unbalanced_near_rest > 16, "{}", without.unbalanced_near_rest);
}

fn a_remaining_imbalance_does_not_keep_steps_short<M: Known>() {
    let [closed, open] = [0.0, 1e-3].map(|missing| run::<M>(&Far { has_floor: true, missing }));
    println!("{:?} with a ledger that closes, {:?} with one that does not", closed.statistics, open.statistics);
    // each step is shortened a few times, and then accepted as a whole
    assert!(open.statistics.accepted <= 2 * closed.statistics.accepted, "{:?}", open.statistics);
    assert!(open.longest > 0.1 * END, "the longest step is {} s", open.longest);
}

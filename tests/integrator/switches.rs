//! Tests that steps end where the equations switch.

use bevel_differential::integrate::{Control, Imbalance, Linearisation, Point, SecondOrder, Statistics, TimedPoint};

use super::continuation::State;
use super::follow::AfterStep;
use super::methods::{Known, with_every_method};

with_every_method!(
    steps_land_on_switches_in_a_few_attempts
    a_system_at_rest_on_a_kink_is_not_held_there
    a_force_that_jumps_does_not_hold_a_body
);

/// An oscillator that is stiffer below zero: v̇ = −q above, −4q below. The test sets the active side.
struct Kinked {
    side: f64,
}

/// Maximum distance between the end of a step and the switch.
const LANDING: f64 = 1e-11;

impl SecondOrder<1> for Kinked {
    type Rates = ();

    fn evaluate(&self, at: &Point<1>) -> ([f64; 1], ()) {
        ([if self.side > 0.0 { -at.q[0] } else { -4.0 * at.q[0] }], ())
    }
    fn linearise(&self, at: &Point<1>) -> Linearisation<1, ()> {
        let slope = if self.side > 0.0 { -1.0 } else { -4.0 };
        Linearisation {
            acceleration: self.evaluate(at).0,
            by_position: [[slope]],
            by_velocity: [[0.0]],
            ledger_rates: (),
        }
    }
    fn weights(&self, _: &Point<1>) -> Point<1> {
        Point { q: [1.0], v: [1.0] }
    }
    fn crossing(&self, start: TimedPoint<1>, end: TimedPoint<1>) -> Option<f64> {
        let (from, to) = (start.point.q[0] * self.side, end.point.q[0] * self.side);
        // aims at the middle of the allowed distance
        (to < -LANDING).then(|| (from + 0.5 * LANDING) / (from - to))
    }
}

fn steps_land_on_switches_in_a_few_attempts<M: Known>() {
    let mut s = Kinked { side: 1.0 };
    let mut state = State { point: Point { q: [1.0], v: [0.0] }, time: 0.0, control: Control::new(1e-3) };
    let mut statistics = Statistics::default();
    let period = 1.5 * std::f64::consts::PI;
    let mut switches = Vec::new();
    while state.time < 10.0 * period {
        let (side, mut landed) = (s.side, false);
        state.integrate::<M, _>(&s, 10.0 * period, &mut statistics, |end, _| {
            assert!(end.q[0] * side >= -LANDING, "no step goes on beyond the switch: {}", end.q[0]);
            landed = end.q[0] * side < 0.0;
            if landed { AfterStep::Stop } else { AfterStep::Continue }
        });
        if landed {
            switches.push(state.time);
            s.side = -s.side;
        }
    }
    let point = state.point;
    println!("{} switches, {statistics:?}", switches.len());
    assert_eq!(switches.len(), 20);
    // the half-periods are π above and π/2 below zero; the first quarter is above
    for (k, at) in switches.iter().enumerate() {
        let expected = std::f64::consts::FRAC_PI_2
            + f64::from(k as u32 / 2) * period
            + if k % 2 == 1 { std::f64::consts::FRAC_PI_2 } else { 0.0 };
        assert!((at - expected).abs() < 1e-8, "switch {k} at {at} instead of {expected}");
    }
    assert!((point.q[0] - 1.0).abs() < 1e-8 && point.v[0].abs() < 1e-7, "{point:?}");
    assert!(statistics.rejected_switch <= 20 * 4, "{statistics:?}");
    assert_eq!(statistics.rejected_invalid, 0);
}

/// A body without forces that has a kink halfway through every step.
struct BeforeKink;

impl SecondOrder<1> for BeforeKink {
    type Rates = ();

    fn evaluate(&self, _: &Point<1>) -> ([f64; 1], ()) {
        ([0.0], ())
    }
    fn linearise(&self, _: &Point<1>) -> Linearisation<1, ()> {
        Linearisation { acceleration: [0.0], by_position: [[0.0]], by_velocity: [[0.0]], ledger_rates: () }
    }
    fn weights(&self, _: &Point<1>) -> Point<1> {
        Point { q: [1.0], v: [1.0] }
    }
    fn kink(&self, _: &Point<1>, _: f64) -> Option<f64> {
        Some(0.5)
    }
}

fn a_system_at_rest_on_a_kink_is_not_held_there<M: Known>() {
    // numbers of this size resolve 1.5e-11, and the body moves by only 1e-12 in total
    let mut state = State { point: Point { q: [1e5], v: [1e-13] }, time: 0.0, control: Control::new(1e-3) };
    let mut statistics = Statistics::default();
    state.integrate::<M, _>(&BeforeKink, 10.0, &mut statistics, |_, _| AfterStep::Continue);
    assert_eq!(state.time, 10.0);
    // from 1 ms on, each step is six times longer
    assert!(statistics.accepted <= 8, "{statistics:?}");
}

/// A body that meets a damper at the position `EDGE`, whose rounding is much larger than that of time.
struct Damper {
    /// Damping over inertia [1/s].
    damping: f64,
}

const EDGE: f64 = 20.9;
/// Speed before the damper, and time at the end of a run.
const SPEED: f64 = 0.0655;
const RUN: f64 = 0.1;

impl SecondOrder<1> for Damper {
    /// Heat of the damping [W].
    type Rates = f64;

    fn evaluate(&self, at: &Point<1>) -> ([f64; 1], f64) {
        let force = if at.q[0] > EDGE { self.damping * at.v[0] } else { 0.0 };
        ([-force], force * at.v[0])
    }
    fn linearise(&self, at: &Point<1>) -> Linearisation<1, f64> {
        let (acceleration, ledger_rates) = self.evaluate(at);
        let slope = if at.q[0] > EDGE { -self.damping } else { 0.0 };
        Linearisation { acceleration, by_position: [[0.0]], by_velocity: [[slope]], ledger_rates }
    }
    fn weights(&self, _: &Point<1>) -> Point<1> {
        Point { q: [1.0], v: [1.0] }
    }
    fn kink(&self, at: &Point<1>, h: f64) -> Option<f64> {
        Some((EDGE - at.q[0]) / (h * at.v[0])).filter(|fraction| (1e-6..1.0).contains(fraction))
    }
    fn energy(&self, at: &Point<1>) -> [f64; 2] {
        [0.5 * at.v[0] * at.v[0], 0.0]
    }
    fn imbalance(&self, [[before, _], [after, _]]: [[f64; 2]; 2], h: f64, [a, m, b]: &[f64; 3]) -> Imbalance {
        let heat = h / 6.0 * (a + 4.0 * m + b);
        let rounding = 1e-13 * (before + after);
        Imbalance { residual: ((after - before + heat).abs() - rounding).max(0.0), exchanged: heat }
    }
    /// Energy of the speed that the error norm does not resolve.
    fn energy_floor(&self, _: [&Point<1>; 2], tolerance: f64, _: f64) -> f64 {
        0.5 * tolerance * tolerance
    }
}

/// With a damping near 1, the jump changes the first correction of an implicit method by about its own size.
fn a_force_that_jumps_does_not_hold_a_body<M: Known>() {
    let mut most = 0;
    for damping in [0.3, 0.8, 0.9, 0.95, 0.99, 1.0, 1.01, 1.1, 3.0, 30.0, 500.0] {
        for k in 0..100 {
            let start = EDGE - 1e-3 * (1.0 + f64::from(k) / 100.0);
            let mut state = State { point: Point { q: [start], v: [SPEED] }, time: 0.0, control: Control::new(1e-4) };
            let mut statistics = Statistics::default();
            state.integrate::<M, _>(&Damper { damping }, RUN, &mut statistics, |_, _| AfterStep::Continue);
            let after = RUN - (EDGE - start) / SPEED;
            let way = -SPEED / damping * (-damping * after).exp_m1();
            assert!((state.point.q[0] - EDGE - way).abs() < 1e-8, "{damping}, {k}: {:?}", state.point);
            most = most.max(statistics.accepted + statistics.rejected_ledger + statistics.rejected_error);
        }
    }
    println!("at most {most} attempts");
    // the decay takes about 1000 attempts at this tolerance; a body held at the jump takes all of its 100 000
    assert!(most < 5000, "{most} attempts");
}

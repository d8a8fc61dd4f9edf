//! A gear pair with backlash under a steady load and a harmonic excitation, which jumps up and down at known
//! frequencies.
//!
//! With x in multiples of half the backlash, and time in units of 1/ω_n:
//!
//!   x″ + 2ζx′ + f(x) = F_m + F_a Ω² sin Ωt,   f(x) = x − 1 for x > 1, 0 in the gap, x + 1 for x < −1
//!
//! (A. Kahraman, R. Singh, Non-linear dynamics of a spur gear pair, Journal of Sound and Vibration 142:49, 1990). Teeth
//! that lift off soften the resonance, which leans to lower frequencies. Between the jumps there are two motions, and
//! the direction of the frequency sweep determines which one occurs.
//!
//! The mesh of the program with one linear spring provides f, with x as its relative position, and the integrator of
//! the program provides the motion. The test adds the terms that a mesh does not have: the damping, which also acts in
//! the gap, and the excitation, whose phase is an imposed motion.

use std::f64::consts::TAU;

use bevel_differential::contact::mesh::{Mesh, MeshState};
use bevel_differential::contact::spring::{ImpactSpring, Resultant};
use bevel_differential::contact::{AnySpring, Damping};
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::integrate::{Control, Linearisation, Point, Rodas5P, SecondOrder, SolverContext, Statistics};

use super::follow::{AfterStep, advance};

/// ζ.
const ZETA: f64 = 0.05;
/// F_m.
const MEAN: f64 = 0.1;
/// F_a.
const EXCITATION: f64 = 0.05;

/// The oscillator at frequency Ω: relative position of the teeth, and phase of the excitation.
struct Oscillator {
    mesh: Mesh,
    frequency: f64,
    /// True if steps end on kinks, as in the program.
    kinks: bool,
}

impl Oscillator {
    fn new(kinks: bool) -> Self {
        let pair = Pair::new(&GearSpec::default());
        // a stiffness of 1 N·m/rad against an inertia of 1 kg·m²: ω_n = 1/s
        let stiffness = 1.0 / (pair.mean_cone * pair.mean_cone);
        let spring = AnySpring::Impact(ImpactSpring::linear(stiffness, pair.mean_cone));
        let whole = Resultant::new(pair.mean_cone, 1.0);
        let mesh = Mesh { is_single: true, ..Mesh::new(&pair, (spring, Damping::NONE), whole, true, 0.05) };
        Self { mesh, frequency: 0.0, kinks }
    }

    /// Load on the drive flanks, which transmit force at negative positions, with its derivative with respect to the
    /// phase [N·m].
    fn load(&self, phase: f64) -> [f64; 2] {
        let (unit, dynamic) = (-self.mesh.half_backlash(), EXCITATION * self.frequency * self.frequency);
        [unit * (MEAN + dynamic * phase.sin()), unit * dynamic * phase.cos()]
    }

    /// x.
    fn displacement(&self, at: &Point<2>) -> f64 {
        -at.q[0] / self.mesh.half_backlash()
    }

    fn state(at: &Point<2>) -> MeshState {
        MeshState { position: [at.q[0], 0.0], rate: [at.v[0], 0.0], ..MeshState::default() }
    }

    /// Deviation of x from its value at rest, and the square of this deviation.
    fn moments(&self, at: &Point<2>) -> [f64; 2] {
        let from_rest = self.displacement(at) - (1.0 + MEAN);
        [from_rest, from_rest * from_rest]
    }
}

impl SecondOrder<2> for Oscillator {
    type Rates = [f64; 2];

    fn evaluate(&self, at: &Point<2>) -> ([f64; 2], [f64; 2]) {
        let force = self.mesh.force(&Self::state(at)).force[0];
        ([force - 2.0 * ZETA * at.v[0] + self.load(at.q[1])[0], 0.0], self.moments(at))
    }

    fn linearise(&self, at: &Point<2>) -> Linearisation<2, [f64; 2]> {
        let (acceleration, ledger_rates) = self.evaluate(at);
        let slope = self.mesh.linearise(&Self::state(at)).1.by_position[0][0];
        let by_position = [[slope, self.load(at.q[1])[1]], [0.0; 2]];
        Linearisation { acceleration, by_position, by_velocity: [[-2.0 * ZETA, 0.0], [0.0; 2]], ledger_rates }
    }

    fn weights(&self, _: &Point<2>) -> Point<2> {
        let unit = 1.0 / self.mesh.half_backlash();
        Point { q: [unit, 1.0], v: [unit, 1.0] }
    }

    fn kink(&self, at: &Point<2>, h: f64) -> Option<f64> {
        if self.kinks { self.mesh.kink(&Self::state(at), h) } else { None }
    }
}

/// Motion that continues from one frequency to the next.
struct Sweep {
    oscillator: Oscillator,
    point: Point<2>,
    control: Control,
    statistics: Statistics,
    periods: u32,
}

/// Number of simulated periods at each frequency.
const PERIODS: u32 = 400;
/// Number of final periods over which the standard deviation is computed. The transient from the previous frequency has
/// decayed before. Twice as many periods give the same stated digits.
const TAKEN: u32 = 100;

impl Sweep {
    /// Creates a sweep that starts at rest on the drive flanks.
    fn new(kinks: bool) -> Self {
        let oscillator = Oscillator::new(kinks);
        let point = Point { q: [-(1.0 + MEAN) * oscillator.mesh.half_backlash(), 0.0], v: [0.0; 2] };
        Self { oscillator, point, control: Control::new(1e-3), statistics: Statistics::default(), periods: 0 }
    }

    /// Standard deviation of x at frequency Ω = `frequency`.
    fn at(&mut self, frequency: f64) -> f64 {
        // the previous frequency ended after a whole number of periods
        (self.oscillator.frequency, self.point.q[1], self.point.v[1]) = (frequency, 0.0, frequency);
        let (period, mut time) = (TAU / frequency, 0.0);
        let mut sums = [0.0; 2];
        for (until, weight) in [(PERIODS - TAKEN, 0.0), (PERIODS, 1.0)] {
            let mut budget = 1_000_000;
            let context = SolverContext {
                tolerance: 1e-6,
                control: &mut self.control,
                statistics: &mut self.statistics,
                budget: &mut budget,
            };
            let until = f64::from(until) * period;
            advance(&Rodas5P, &self.oscillator, &mut self.point, &mut time, until, context, |step| {
                let [begin, middle, end] = step.ledger_rates;
                for i in 0..2 {
                    sums[i] += weight * step.h / 6.0 * (begin[i] + 4.0 * middle[i] + end[i]);
                }
                AfterStep::Continue
            })
            .unwrap();
        }
        self.periods += PERIODS;
        let [mean, square] = sums.map(|sum| sum / (f64::from(TAKEN) * period));
        (square - mean * mean).sqrt()
    }

    /// Returns the standard deviation of x for each Ω, in thousandths.
    fn over(&mut self, thousandths: impl Iterator<Item = u32>) -> Vec<(u32, f64)> {
        thousandths.map(|n| (n, self.at(f64::from(n) * 1e-3))).collect()
    }
}

/// Frequencies before and after the only jump of a sweep. All other changes of the motion are below a tenth of the
/// jump.
fn only_jump(sweep: &[(u32, f64)]) -> (u32, u32) {
    let mut changes: Vec<_> = sweep.windows(2).map(|w| ((w[1].1 - w[0].1).abs(), w[0].0, w[1].0)).collect();
    changes.sort_by(|a, b| b.0.total_cmp(&a.0));
    assert!(changes[1].0 < 0.1 * changes[0].0, "{:?}", &changes[..2]);
    (changes[0].1, changes[0].2)
}

/// Frequencies at which both sweeps find the same motion, and its standard deviation to these digits.
const KNOWN: [(u32, f64); 4] = [(500, 0.01176), (900, 0.16286), (1000, 0.13308), (1200, 0.09421)];
/// The last digit.
const DIGIT: f64 = 1e-5;

fn assert_known(sweep: &[(u32, f64)]) {
    for (frequency, expected) in KNOWN {
        let (_, found) = *sweep.iter().find(|point| point.0 == frequency).unwrap();
        println!("Ω = {}: {found:.6}", f64::from(frequency) * 1e-3);
        assert!((found - expected).abs() < DIGIT, "Ω = {frequency}e-3: {found} instead of {expected}");
    }
}

#[test]
fn rising_frequency_jumps_up_between_0_828_and_0_830() {
    let mut sweep = Sweep::new(true);
    let up = sweep.over((500..=1200).step_by(2));
    println!("{} periods, {:?}", sweep.periods, sweep.statistics);
    assert_eq!(only_jump(&up), (828, 830));
    assert_known(&up);
}

#[test]
fn falling_frequency_jumps_down_between_0_710_and_0_708() {
    let mut sweep = Sweep::new(true);
    let down = sweep.over((500..=1200).rev().step_by(2));
    println!("{} periods, {:?}", sweep.periods, sweep.statistics);
    assert_eq!(only_jump(&down), (710, 708));
    assert_known(&down);
}

#[test]
fn separating_teeth_cost_fewer_steps_with_predicted_kinks() {
    let attempts = |frequency: u32, kinks: bool| {
        let mut sweep = Sweep::new(kinks);
        let deviation = sweep.at(f64::from(frequency) * 1e-3);
        let (steps, rejected) = (sweep.statistics.accepted, sweep.statistics.rejected_error);
        let each = |count: u64| count as f64 / f64::from(PERIODS);
        println!("Ω = {frequency}e-3, {kinks}: {:.1} steps a period, {:.1} rejected", each(steps), each(rejected));
        (each(steps + rejected), deviation)
    };
    // at Ω = 0.5, the teeth stay in contact
    assert_eq!(attempts(500, true), attempts(500, false));
    for frequency in [830, 900, 1000, 1200] {
        let (seen, unseen) = (attempts(frequency, true), attempts(frequency, false));
        assert!(seen.0 < unseen.0 && (seen.1 - unseen.1).abs() < DIGIT);
    }
}

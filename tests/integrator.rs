//! The integrator on problems whose solutions are known: order, stability, imposed motion, impact, failure.

use bevel_differential::contact::impact::Impact;
use bevel_differential::integrate::{
    Control, Effort, Failure, Flow, Linearisation, Point, RODAS5P, Rodas5P, SecondOrder, Statistics, advance, in_pairs,
    step,
};

/// A system given by its acceleration and that acceleration's derivatives.
struct System<F, const N: usize> {
    acceleration: F,
}

type Jet<const N: usize> = ([f64; N], [[f64; N]; N], [[f64; N]; N]);

impl<const N: usize, F: Fn(&Point<N>) -> Jet<N>> SecondOrder<N> for System<F, N> {
    type Power = ();

    fn evaluate(&self, at: &Point<N>) -> ([f64; N], ()) {
        ((self.acceleration)(at).0, ())
    }

    fn linearise(&self, at: &Point<N>) -> Linearisation<N, ()> {
        let (acceleration, by_position, by_velocity) = (self.acceleration)(at);
        Linearisation { acceleration, by_position, by_velocity, power: () }
    }

    fn weights(&self, _: &Point<N>) -> Point<N> {
        Point { q: [1.0; N], v: [1.0; N] }
    }
}

fn system<const N: usize, F: Fn(&Point<N>) -> Jet<N>>(acceleration: F) -> System<F, N> {
    System { acceleration }
}

/// Pendulum with cubic damping: smooth and nonlinear in position and velocity.
fn pendulum(p: &Point<1>) -> Jet<1> {
    let (q, v) = (p.q[0], p.v[0]);
    ([-q.sin() - 0.1 * v.powi(3) - 0.2 * v], [[-q.cos()]], [[-0.3 * v * v - 0.2]])
}

const START: Point<1> = Point { q: [1.0], v: [0.5] };

fn distance<const N: usize>(a: &Point<N>, b: &Point<N>) -> f64 {
    (0..N).map(|i| (a.q[i] - b.q[i]).abs().max((a.v[i] - b.v[i]).abs())).fold(0.0, f64::max)
}

/// `count` equal steps over `length`; the end and the sum of error estimates.
fn fixed<const N: usize, S: SecondOrder<N>>(s: &S, mut at: Point<N>, length: f64, count: u32) -> Point<N> {
    for _ in 0..count {
        let lin = s.linearise(&at);
        at = step(&RODAS5P, s, &at, &lin, length / f64::from(count)).unwrap().end;
    }
    at
}

#[test]
fn solution_is_of_order_five_and_its_error_estimate_and_middle_of_order_four() {
    let s = system(pendulum);
    let reference = fixed(&s, START, 0.8, 4096);
    let error = |count| distance(&fixed(&s, START, 0.8, count), &reference);
    let order = (error(8) / error(16)).log2();
    assert!((4.7..5.6).contains(&order), "order of the solution {order}");

    // one step: local orders are one higher
    let lin = s.linearise(&START);
    let one = |h: f64| step(&RODAS5P, &s, &START, &lin, h).unwrap();
    let estimate = |h: f64| distance(&one(h).error, &Point::ZERO);
    let order = (estimate(0.1) / estimate(0.05)).log2();
    assert!((4.7..5.5).contains(&order), "local order of the estimate {order}");
    let middle = |h: f64| distance(&one(h).middle, &fixed(&s, START, h / 2.0, 256));
    let order = (middle(0.2) / middle(0.1)).log2();
    assert!(order > 4.5, "local order of the middle {order}");
}

#[test]
fn order_survives_stiffness_with_smooth_forcing() {
    // Prothero-Robinson: v' = −λ (v − cos c) − sin c with the clock c' = 1 as an imposed motion; v = cos c solves it
    let lambda = 1e5;
    let s = system(move |p: &Point<2>| {
        let c = p.q[1];
        let forcing = lambda * c.cos() - c.sin();
        let slope = -lambda * c.sin() - c.cos();
        ([-lambda * p.v[0] + forcing, 0.0], [[0.0, slope], [0.0; 2]], [[-lambda, 0.0], [0.0; 2]])
    });
    let start = Point { q: [0.0, 0.0], v: [1.0, 1.0] };
    let error = |count| (fixed(&s, start, 1.0, count).v[0] - 1f64.cos()).abs();
    let order = (error(10) / error(20)).log2();
    assert!(error(10) < 1e-7 && order > 2.8, "error {:e}, order {order}", error(10));
}

#[test]
fn infinitely_stiff_motion_is_damped_in_one_step() {
    for rate in [1e6, 1e10, 1e14] {
        let s = system(move |p: &Point<1>| ([-rate * p.v[0]], [[0.0]], [[-rate]]));
        let start = Point { q: [0.0], v: [1.0] };
        let end = fixed(&s, start, 1.0, 1);
        // R(z) falls as 1/z
        assert!(end.v[0].abs() < 100.0 / rate, "rate {rate}: {}", end.v[0]);
    }
    // and an oscillation far faster than the step as well
    let s = system(|p: &Point<1>| ([-1e16 * p.q[0]], [[-1e16]], [[0.0]]));
    let end = fixed(&s, Point { q: [1.0], v: [0.0] }, 1.0, 1);
    assert!(end.q[0].abs() < 1e-6, "{}", end.q[0]);
}

fn run<const N: usize, S: SecondOrder<N>>(
    s: &S,
    point: &mut Point<N>,
    until: f64,
    tolerance: f64,
) -> Result<Statistics, Failure<()>> {
    let (mut time, mut control, mut statistics) = (0.0, Control::new(1e-6), Statistics::default());
    let mut budget = 1_000_000;
    let effort = Effort { tolerance, control: &mut control, statistics: &mut statistics, budget: &mut budget };
    advance(&Rodas5P, s, point, &mut time, until, effort, |_| Ok(Flow::Continue))?;
    Ok(statistics)
}

#[test]
fn adaptive_error_follows_the_tolerance() {
    let s = system(pendulum);
    let reference = fixed(&s, START, 3.0, 20_000);
    let mut last = f64::INFINITY;
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut point = START;
        run(&s, &mut point, 3.0, tolerance).unwrap();
        let error = distance(&point, &reference);
        assert!(error < 20.0 * tolerance && error < last, "tolerance {tolerance:e}: error {error:e}");
        last = error;
    }
}

/// A mass flying into a contact law along −d: position d is the penetration.
fn bouncing(law: Impact, mass: f64) -> System<impl Fn(&Point<1>) -> Jet<1>, 1> {
    system(move |p: &Point<1>| {
        if p.q[0] <= 0.0 {
            return ([0.0], [[0.0]], [[0.0]]);
        }
        let f = law.force(p.q[0], p.v[0]);
        ([-f.total / mass], [[-f.by_depth / mass]], [[-f.by_rate / mass]])
    })
}

/// Scales of an impact: penetrations of micrometres, speeds of metres per second.
struct Scaled<S>(S, f64, f64);

impl<S: SecondOrder<1>> SecondOrder<1> for Scaled<S> {
    type Power = S::Power;

    fn evaluate(&self, at: &Point<1>) -> ([f64; 1], S::Power) {
        self.0.evaluate(at)
    }
    fn linearise(&self, at: &Point<1>) -> Linearisation<1, S::Power> {
        self.0.linearise(at)
    }
    fn weights(&self, _: &Point<1>) -> Point<1> {
        Point { q: [1.0 / self.1], v: [1.0 / self.2] }
    }
}

#[test]
fn hertz_impact_has_the_closed_form_depth_force_and_duration() {
    let golden: serde_json::Value = serde_json::from_str(include_str!("data/golden_contact_bench.json")).unwrap();
    for case in ["hertz_impact_m1kg_v1_K1.732e10", "hertz_impact_m0.5_v0.1_K1e9"] {
        let g = |key: &str| golden[case][key].as_f64().unwrap();
        let (m, v, k) = (g("m"), g("v"), g("K"));
        let law = Impact { stiffness: k, exponent: 1.5, damping: 0.0, per_full_depth: 1e4 };
        let s = Scaled(bouncing(law, m), g("delta_max"), v);
        let at = |time: f64| {
            let mut point = Point { q: [0.0], v: [v] };
            run(&s, &mut point, time, 1e-10).unwrap();
            point
        };
        // deepest where the speed changes sign, released where the depth does
        let zero = |mut lo: f64, mut hi: f64, f: &dyn Fn(f64) -> f64| {
            for _ in 0..60 {
                let middle = 0.5 * (lo + hi);
                if f(middle) > 0.0 { lo = middle } else { hi = middle }
            }
            lo
        };
        let contact = g("t_contact");
        let deepest = zero(0.3 * contact, 0.7 * contact, &|t| at(t).v[0]);
        let depth = at(deepest).q[0];
        let release = zero(0.8 * contact, 1.2 * contact, &|t| at(t).q[0]);
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
        assert!(close(depth, g("delta_max")), "{case}: depth {depth:e}");
        assert!(close(law.force(depth, 0.0).total, g("F_max")), "{case}");
        assert!(close(release, contact), "{case}: duration {release:e}");
        assert!(close(at(1.5 * contact).v[0], -v), "{case}: speed of return");
    }
}

#[test]
fn a_step_that_cannot_be_taken_leaves_the_last_good_state() {
    let s = system(|p: &Point<1>| ([if p.q[0] > 1.0 { f64::NAN } else { 0.0 }], [[0.0]], [[0.0]]));
    let mut point = Point { q: [0.0], v: [1.0] };
    let failure = run(&s, &mut point, 2.0, 1e-6).unwrap_err();
    assert!(matches!(failure, Failure::StepTooSmall { .. }), "{failure:?}");
    assert!(point.q[0] <= 1.0 && point.q[0] > 0.999 && point.v[0] == 1.0, "{point:?}");
}

#[test]
fn a_run_repeats_to_the_bit() {
    let s = system(pendulum);
    let (mut a, mut b) = (START, START);
    let (first, second) = (run(&s, &mut a, 3.0, 1e-7).unwrap(), run(&s, &mut b, 3.0, 1e-7).unwrap());
    assert_eq!((a, first), (b, second));
}

/// Integrates until the observer stops it, if it does.
fn stretch<const N: usize, S: SecondOrder<N>>(
    s: &S,
    (point, time): (&mut Point<N>, &mut f64),
    until: f64,
    control: &mut Control,
    statistics: &mut Statistics,
    mut observe: impl FnMut(&Point<N>, f64) -> Flow,
) {
    let mut budget = 100_000;
    let effort = Effort { tolerance: 1e-10, control, statistics, budget: &mut budget };
    advance(&Rodas5P, s, point, time, until, effort, |step| Ok::<_, ()>(observe(step.end, step.time))).unwrap();
}

#[test]
fn a_run_that_is_stopped_goes_on_to_the_same_bits() {
    let s = system(pendulum);
    let (mut whole, mut whole_time, mut control) = (START, 0.0, Control::new(1e-6));
    let (mut statistics, mut seen) = (Statistics::default(), Vec::new());
    stretch(&s, (&mut whole, &mut whole_time), 3.0, &mut control, &mut statistics, |end, time| {
        seen.push((*end, time));
        Flow::Continue
    });
    let (mut point, mut time, mut counted, mut again) = (START, 0.0, Statistics::default(), Control::new(1e-6));
    let mut stops = 0;
    while time < 3.0 {
        let mut steps = 0;
        stretch(&s, (&mut point, &mut time), 3.0, &mut again, &mut counted, |end, at| {
            assert_eq!((*end, at), seen[3 * stops + steps]);
            steps += 1;
            if steps == 3 { Flow::Stop } else { Flow::Continue }
        });
        assert_eq!((point, time), seen[3 * stops + steps - 1], "stopped at the step that was observed");
        stops += 1;
    }
    assert!(stops > 5);
    assert_eq!((point, time, again), (whole, whole_time, control));
    assert_eq!((counted.accepted, counted.rejected_error), (statistics.accepted, statistics.rejected_error));
}

/// An oscillator that is stiffer below zero: v̇ = −q above, −4q below. Which of both is chosen from outside.
struct Kinked {
    side: f64,
}

/// How closely a step must end on the switch.
const LANDING: f64 = 1e-11;

impl SecondOrder<1> for Kinked {
    type Power = ();

    fn evaluate(&self, at: &Point<1>) -> ([f64; 1], ()) {
        ([if self.side > 0.0 { -at.q[0] } else { -4.0 * at.q[0] }], ())
    }
    fn linearise(&self, at: &Point<1>) -> Linearisation<1, ()> {
        let slope = if self.side > 0.0 { -1.0 } else { -4.0 };
        Linearisation { acceleration: self.evaluate(at).0, by_position: [[slope]], by_velocity: [[0.0]], power: () }
    }
    fn weights(&self, _: &Point<1>) -> Point<1> {
        Point { q: [1.0], v: [1.0] }
    }
    fn crossing(&self, start: &Point<1>, end: &Point<1>) -> Option<f64> {
        let (from, to) = (start.q[0] * self.side, end.q[0] * self.side);
        // to the middle of what counts as landed
        (to < -LANDING).then(|| (from + 0.5 * LANDING) / (from - to))
    }
}

#[test]
fn steps_land_on_switches_in_a_few_attempts() {
    let mut s = Kinked { side: 1.0 };
    let (mut point, mut time) = (Point { q: [1.0], v: [0.0] }, 0.0);
    let (mut control, mut statistics) = (Control::new(1e-3), Statistics::default());
    let period = 1.5 * std::f64::consts::PI;
    let mut switches = Vec::new();
    while time < 10.0 * period {
        let (side, mut landed) = (s.side, false);
        stretch(&s, (&mut point, &mut time), 10.0 * period, &mut control, &mut statistics, |end, _| {
            assert!(end.q[0] * side >= -LANDING, "no step goes on beyond the switch: {}", end.q[0]);
            landed = end.q[0] * side < 0.0;
            if landed { Flow::Stop } else { Flow::Continue }
        });
        if landed {
            switches.push(time);
            s.side = -s.side;
        }
    }
    println!("{} switches, {statistics:?}", switches.len());
    assert_eq!(switches.len(), 20);
    // half a period of π above and of π/2 below, the first quarter above
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

/// One body with four alike ones around it, `N` − 1 of them simulated, each counted as often as makes four.
struct Alike<const N: usize>;

impl<const N: usize> Alike<N> {
    const MEMBERS: f64 = 4.0 / (N - 1) as f64;

    /// Force on body `j` with its derivatives by its distance and relative speed: hardening, with nonlinear damping.
    fn force(at: &Point<N>, j: usize) -> [f64; 3] {
        let (d, v) = (at.q[j] - at.q[0], at.v[j] - at.v[0]);
        [
            -30.0 * d - 200.0 * d * d * d - 0.3 * v - 0.1 * d * d * v,
            -30.0 - 600.0 * d * d - 0.2 * d * v,
            -0.3 - 0.1 * d * d,
        ]
    }
}

impl<const N: usize> SecondOrder<N> for Alike<N> {
    /// Power at the first body.
    type Power = f64;
    const ALIKE: (usize, usize) = (1, N - 1);

    fn evaluate(&self, at: &Point<N>) -> ([f64; N], f64) {
        let lin = self.linearise(at);
        (lin.acceleration, lin.power)
    }
    fn linearise(&self, at: &Point<N>) -> Linearisation<N, f64> {
        let (mut by_position, mut by_velocity, mut acceleration) = ([[0.0; N]; N], [[0.0; N]; N], [0.0; N]);
        let own = [-2.0 * at.q[0].sin(), -2.0 * at.q[0].cos()];
        let total = |i: usize| in_pairs(N - 1, |j| Self::MEMBERS * Self::force(at, 1 + j)[i]);
        acceleration[0] = (own[0] - total(0)) / 3.0;
        by_position[0][0] = (own[1] + total(1)) / 3.0;
        by_velocity[0][0] = total(2) / 3.0;
        for j in 1..N {
            let [f, by_d, by_v] = Self::force(at, j);
            acceleration[j] = f / 0.7;
            (by_position[j][j], by_position[j][0]) = (by_d / 0.7, -by_d / 0.7);
            (by_velocity[j][j], by_velocity[j][0]) = (by_v / 0.7, -by_v / 0.7);
            by_position[0][j] = -Self::MEMBERS * by_d / 3.0;
            by_velocity[0][j] = -Self::MEMBERS * by_v / 3.0;
        }
        Linearisation { acceleration, by_position, by_velocity, power: acceleration[0] * at.v[0] }
    }
    fn weights(&self, _: &Point<N>) -> Point<N> {
        Point { q: [1.0; N], v: [0.5; N] }
    }
}

/// Bits of the first body and of one of the others, of the ledger, and counts.
fn alike<const N: usize>() -> (Vec<[u64; 7]>, Statistics) {
    let s = Alike::<N>;
    let mut point = Point { q: [0.2; N], v: [-1.3; N] };
    (point.q[0], point.v[0]) = (0.5, 3.0);
    let (mut time, mut control, mut statistics, mut budget) = (0.0, Control::new(1e-4), Statistics::default(), 100_000);
    let effort = Effort { tolerance: 1e-7, control: &mut control, statistics: &mut statistics, budget: &mut budget };
    let mut bits = Vec::new();
    advance(&Rodas5P, &s, &mut point, &mut time, 4.0, effort, |step| {
        let Point { q, v } = step.end;
        assert!((1..N).all(|j| (q[j], v[j]) == (q[1], v[1])), "twins stay twins");
        bits.push([q[0], q[1], v[0], v[1], step.power[0], step.power[1], step.power[2]].map(f64::to_bits));
        Ok::<_, ()>(Flow::Continue)
    })
    .unwrap();
    (bits, statistics)
}

#[test]
fn alike_bodies_simulated_together_or_once_and_counted_give_the_same_bits() {
    let (one, two, four) = (alike::<2>(), alike::<3>(), alike::<5>());
    assert!(one.0.len() > 50, "{:?}", one.1);
    assert_eq!(one, two);
    assert_eq!(one, four);
}

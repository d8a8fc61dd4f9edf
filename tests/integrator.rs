//! The integrator on problems whose solutions are known: order, stability, imposed motion, impact, failure.

use bevel_differential::contact::impact::Impact;
use bevel_differential::integrate::{
    Control, Effort, Failure, Flow, Linearisation, Point, RODAS5P, SecondOrder, Statistics, advance, step,
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
    advance(s, point, &mut time, until, effort, |_| Ok(Flow::Continue))?;
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

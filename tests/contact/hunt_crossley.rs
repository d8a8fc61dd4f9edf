//! A mass hits a wall under F = F_el (1 + λ ḋ) and rebounds with the speed of the exact relation for any elastic law.

use bevel_differential::contact::damping::{Damping, restitution};
use bevel_differential::integrate::{
    AfterStep, Control, Linearisation, Point, Rodas5P, SecondOrder, SolverContext, Statistics, advance,
};

/// A mass flying into a wall of elastic force K d^n; position is the penetration.
struct Wall {
    mass: f64,
    stiffness: f64,
    exponent: f64,
    damping: Damping,
    /// Scales of depth [m] and speed [m/s].
    scale: [f64; 2],
}

impl SecondOrder<1> for Wall {
    type Rates = ();

    fn evaluate(&self, at: &Point<1>) -> ([f64; 1], ()) {
        (self.linearise(at).acceleration, ())
    }

    fn linearise(&self, at: &Point<1>) -> Linearisation<1, ()> {
        let (d, rate) = (at.q[0], at.v[0]);
        if d <= 0.0 {
            return Linearisation { acceleration: [0.0], by_position: [[0.0]], by_velocity: [[0.0]], ledger_rates: () };
        }
        let slope = self.stiffness * self.exponent * d.powf(self.exponent - 1.0);
        let f = self.damping.apply(slope * d / self.exponent, slope, d, rate);
        Linearisation {
            acceleration: [-f.total / self.mass],
            by_position: [[-f.by_depth / self.mass]],
            by_velocity: [[-f.by_rate / self.mass]],
            ledger_rates: (),
        }
    }

    fn weights(&self, _: &Point<1>) -> Point<1> {
        Point { q: [1.0 / self.scale[0]], v: [1.0 / self.scale[1]] }
    }
}

/// Speed of return over speed of impact, and steps taken.
fn rebound(exponent: f64, dimensionless: f64) -> (f64, Statistics) {
    let (mass, stiffness, speed) = (0.7, 1.7e10f64.powf(exponent / 1.5), 0.8);
    // depth of the undamped impact: m v²/2 = K d^(n+1)/(n+1)
    let depth = (0.5 * (exponent + 1.0) * mass * speed * speed / stiffness).powf(1.0 / (exponent + 1.0));
    let damping = Damping::HuntCrossley { lambda: dimensionless / speed };
    let wall = Wall { mass, stiffness, exponent, damping, scale: [depth, speed] };
    let mut point = Point { q: [0.0], v: [speed] };
    let (mut time, mut control, mut statistics, mut budget) =
        (0.0, Control::new(1e-8), Statistics::default(), 1_000_000);
    let context =
        SolverContext { tolerance: 1e-10, control: &mut control, statistics: &mut statistics, budget: &mut budget };
    // an undamped impact lasts about three times depth/speed, the slowest return here not three times that
    advance(&Rodas5P, &wall, &mut point, &mut time, 12.0 * depth / speed, context, |_| {
        Ok::<_, ()>(AfterStep::Continue)
    })
    .unwrap();
    assert!(point.q[0] < 0.0, "still in contact");
    (-point.v[0] / speed, statistics)
}

#[test]
fn integrated_impacts_return_with_the_speed_of_the_exact_relation() {
    for exponent in [1.0, 1.5] {
        for dimensionless in [0.1, 0.5, 1.0, 2.0] {
            let (e, statistics) = rebound(exponent, dimensionless);
            let exact = restitution(dimensionless);
            let error = (e - exact).abs();
            println!("n = {exponent}, D = {dimensionless}: e = {e:.10}, error {error:.1e}, {statistics:?}");
            assert!(error < 1e-6, "n = {exponent}, D = {dimensionless}: {e} for {exact}");
        }
    }
}

#[test]
fn an_undamped_impact_rebounds_with_its_initial_speed() {
    for exponent in [1.0, 1.5] {
        assert!((rebound(exponent, 0.0).0 - 1.0).abs() < 1e-7);
    }
}

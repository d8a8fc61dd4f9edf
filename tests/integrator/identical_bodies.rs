//! Identical bodies may be simulated once and counted several times. The default method then gives the same bits as for
//! separately simulated bodies.

use bevel_differential::integrate::{Control, Linearisation, Point, Rodas5P, SecondOrder, SolverContext, Statistics};

use super::follow::{AfterStep, advance};

/// A body surrounded by four identical bodies. `N` − 1 of these are simulated, each counted as often as needed to
/// represent four.
struct Identical<const N: usize>;

impl<const N: usize> Identical<N> {
    const MEMBERS: f64 = 4.0 / (N - 1) as f64;

    /// Force on body `j` with its derivatives with respect to distance and relative speed: hardening, with nonlinear
    /// damping.
    fn force(at: &Point<N>, j: usize) -> [f64; 3] {
        let (d, v) = (at.q[j] - at.q[0], at.v[j] - at.v[0]);
        [
            -30.0 * d - 200.0 * d * d * d - 0.3 * v - 0.1 * d * d * v,
            -30.0 - 600.0 * d * d - 0.2 * d * v,
            -0.3 - 0.1 * d * d,
        ]
    }
}

impl<const N: usize> SecondOrder<N> for Identical<N> {
    /// Power at the first body.
    type Rates = f64;

    fn inner(&self) -> std::ops::Range<usize> {
        1..N
    }

    fn evaluate(&self, at: &Point<N>) -> ([f64; N], f64) {
        let lin = self.linearise(at);
        (lin.acceleration, lin.ledger_rates)
    }
    fn linearise(&self, at: &Point<N>) -> Linearisation<N, f64> {
        let (mut by_position, mut by_velocity, mut acceleration) = ([[0.0; N]; N], [[0.0; N]; N], [0.0; N]);
        let own = [-2.0 * at.q[0].sin(), -2.0 * at.q[0].cos()];
        let of = |j: usize, i: usize| Self::MEMBERS * Self::force(at, 1 + j)[i];
        let two = |j: usize, i: usize| of(j, i) + of(j + 1, i);
        let total = |i: usize| match N - 1 {
            1 => of(0, i),
            2 => two(0, i),
            _ => two(0, i) + two(2, i),
        };
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
        Linearisation { acceleration, by_position, by_velocity, ledger_rates: acceleration[0] * at.v[0] }
    }
    fn weights(&self, _: &Point<N>) -> Point<N> {
        Point { q: [1.0; N], v: [0.5; N] }
    }
}

/// Returns the bits of the first body, of another body and of the ledger, and the counts.
fn run<const N: usize>() -> (Vec<[u64; 7]>, Statistics) {
    let s = Identical::<N>;
    let mut point = Point { q: [0.2; N], v: [-1.3; N] };
    (point.q[0], point.v[0]) = (0.5, 3.0);
    let (mut time, mut control, mut statistics, mut budget) = (0.0, Control::new(1e-4), Statistics::default(), 100_000);
    let context =
        SolverContext { tolerance: 1e-7, control: &mut control, statistics: &mut statistics, budget: &mut budget };
    let mut bits = Vec::new();
    advance(&Rodas5P, &s, &mut point, &mut time, 4.0, context, |step| {
        let Point { q, v } = step.end;
        assert!((1..N).all(|j| (q[j], v[j]) == (q[1], v[1])), "twins stay twins");
        bits.push(
            [q[0], q[1], v[0], v[1], step.ledger_rates[0], step.ledger_rates[1], step.ledger_rates[2]]
                .map(f64::to_bits),
        );
        AfterStep::Continue
    })
    .unwrap();
    (bits, statistics)
}

#[test]
fn identical_bodies_simulated_separately_or_once_and_counted_give_the_same_bits() {
    let (one, two, four) = (run::<2>(), run::<3>(), run::<5>());
    assert!(one.0.len() > 50, "{:?}", one.1);
    assert_eq!(one, two);
    assert_eq!(one, four);
}

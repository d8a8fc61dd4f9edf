//! Tests that runs are repeatable, continue after a stop, and return to a snapshot bit for bit. Impossible runs must
//! fail cleanly.

use bevel_differential::integrate::{Control, Failure, Point, SecondOrder, SolverContext, Statistics};

use super::follow::{AfterStep, advance};
use super::methods::{Known, run, with_every_method};
use super::problems::{Logarithmic, system};

with_every_method!(
    a_run_repeats_to_the_bit
    a_stopped_run_continues_to_the_same_bits
    a_snapshot_is_restored_to_the_same_bits
    a_failed_step_leaves_the_last_valid_state
);

/// All data that a run depends on, and therefore its snapshot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<const N: usize> {
    pub point: Point<N>,
    pub time: f64,
    pub control: Control,
}

impl<const N: usize> State<N> {
    /// Integrates to `until`, or until the observer stops the run.
    pub fn integrate<M: Known, S: SecondOrder<N>>(
        &mut self,
        s: &S,
        until: f64,
        statistics: &mut Statistics,
        mut observe: impl FnMut(&Point<N>, f64) -> AfterStep,
    ) {
        let (Self { point, time, control }, mut budget) = (self, 100_000);
        let context = SolverContext { tolerance: 1e-10, control, statistics, budget: &mut budget };
        advance(&M::METHOD, s, point, time, until, context, |step| observe(step.end, step.time)).unwrap();
    }
}

fn start() -> State<2> {
    State { point: Logarithmic::exact(0.0), time: 0.0, control: Control::new(1e-6) }
}

fn a_run_repeats_to_the_bit<M: Known>() {
    let once = || {
        let mut point = Logarithmic::exact(0.0);
        let statistics = run::<M, 2, _>(&Logarithmic, &mut point, 3.0, 1e-7).unwrap();
        (point, statistics)
    };
    assert_eq!(once(), once());
}

fn a_stopped_run_continues_to_the_same_bits<M: Known>() {
    let (mut whole, mut statistics, mut seen) = (start(), Statistics::default(), Vec::new());
    whole.integrate::<M, _>(&Logarithmic, 3.0, &mut statistics, |end, time| {
        seen.push((*end, time));
        AfterStep::Continue
    });
    let (mut state, mut counted, mut stops) = (start(), Statistics::default(), 0);
    while state.time < 3.0 {
        let mut steps = 0;
        state.integrate::<M, _>(&Logarithmic, 3.0, &mut counted, |end, at| {
            assert_eq!((*end, at), seen[3 * stops + steps]);
            steps += 1;
            if steps == 3 { AfterStep::Stop } else { AfterStep::Continue }
        });
        assert_eq!((state.point, state.time), seen[3 * stops + steps - 1], "stopped at the step that was observed");
        stops += 1;
    }
    assert!(stops > 5);
    assert_eq!(state, whole);
    assert_eq!((counted.accepted, counted.rejected_error), (statistics.accepted, statistics.rejected_error));
}

fn a_snapshot_is_restored_to_the_same_bits<M: Known>() {
    let trace = |state: &mut State<2>, until: f64| {
        let mut seen = Vec::new();
        state.integrate::<M, _>(&Logarithmic, until, &mut Statistics::default(), |end, time| {
            seen.push((*end, time));
            AfterStep::Continue
        });
        seen
    };
    let mut state = start();
    for until in [0.37, 0.4, 1.9, 3.0] {
        let snapshot = state;
        let first = trace(&mut state, until);
        let reached = state;
        // run further, then return to the snapshot
        trace(&mut state, until + 1.0);
        state = snapshot;
        assert_eq!(trace(&mut state, until), first);
        assert_eq!(state, reached);
    }
}

fn a_failed_step_leaves_the_last_valid_state<M: Known>() {
    let s = system(|p: &Point<1>| ([if p.q[0] > 1.0 { f64::NAN } else { 0.0 }], [[0.0]], [[0.0]]));
    let mut point = Point { q: [0.0], v: [1.0] };
    let failure = run::<M, 1, _>(&s, &mut point, 2.0, 1e-6).unwrap_err();
    assert!(matches!(failure, Failure::StepTooSmall { .. }), "{failure:?}");
    assert!(point.q[0] <= 1.0 && point.q[0] > 0.999 && point.v[0] == 1.0, "{point:?}");
}

//! Tests of dense output: steps continue beyond the requested times and do not depend on them.

use bevel_differential::integrate::{Control, Point, SecondOrder, SolverContext, Statistics, Step, Trajectory};

use super::follow::{AfterStep, proceed};
use super::methods::{Known, with_every_method};
use super::problems::{Logarithmic, distance, forced};

with_every_method!(
    steps_do_not_depend_on_the_requested_times
    the_motion_between_steps_is_within_the_tolerance
    the_motion_between_long_steps_of_stiff_problems_is_within_the_tolerance
    a_step_is_completed_up_to_the_end_of_the_equations
);

const STOP: f64 = 3.0;
const TOLERANCE: f64 = 1e-8;

/// Record of a run: bits of its steps, its counts, and the requested points.
struct Seen {
    steps: Vec<[u64; 4]>,
    counts: Statistics,
    shown: Vec<(f64, Point<2>)>,
}

fn run<M: Known>(times: &[f64]) -> Seen {
    run_of::<M, _>(&Logarithmic, Logarithmic::exact(0.0), times)
}

fn run_of<M: Known, S: SecondOrder<2>>(system: &S, start: Point<2>, times: &[f64]) -> Seen {
    let mut seen = Seen { steps: Vec::new(), counts: Statistics::default(), shown: Vec::new() };
    let mut control = Control::new(1e-4);
    let mut trajectory = Trajectory { end: f64::INFINITY, ..Trajectory::new(start, 0.0, STOP) };
    for &time in times {
        let Seen { steps, counts, .. } = &mut seen;
        let mut budget = 10_000;
        let context =
            SolverContext { tolerance: TOLERANCE, control: &mut control, statistics: counts, budget: &mut budget };
        let observe = |step: Step<2, S::Rates>| {
            assert!(step.time < time, "nothing beyond {time} is completed");
            steps.push([step.h, step.time, step.end.q[0], step.end.v[1]].map(f64::to_bits));
            AfterStep::Continue
        };
        proceed(&M::METHOD, system, &mut trajectory, time, context, observe).unwrap();
        let pending = trajectory.pending.as_ref().unwrap();
        let at = trajectory.extension.at((time - trajectory.time) / pending.h);
        seen.shown.push((time, at));
    }
    seen
}

fn even(count: u32) -> Vec<f64> {
    (1..=count).map(|k| STOP * f64::from(k) / f64::from(count)).collect()
}

fn steps_do_not_depend_on_the_requested_times<M: Known>() {
    let whole = run::<M>(&[STOP]);
    assert!(whole.steps.len() > 20);
    let irregular: Vec<f64> = (1..=300).map(|k| STOP * (f64::from(k) / 300.0).powi(3)).collect();
    for times in [even(7), even(100), even(20_000), irregular] {
        let seen = run::<M>(&times);
        assert_eq!(seen.steps, whole.steps);
        assert_eq!(seen.counts, whole.counts);
    }
}

fn the_motion_between_steps_is_within_the_tolerance<M: Known>() {
    let mut largest = 0.0f64;
    for (time, at) in run::<M>(&even(5000)).shown {
        largest = largest.max(distance(&at, &Logarithmic::exact(time)));
    }
    println!("{:.1} tolerances", largest / TOLERANCE);
    assert!(largest < 10.0 * TOLERANCE, "{largest:e}");
}

/// The smooth motion allows steps thousands of times longer than the stiff part would need. A dense output without
/// error control would be wrong by tens of tolerances here.
fn the_motion_between_long_steps_of_stiff_problems_is_within_the_tolerance<M: Known>() {
    for lambda in [1e4, 1e6] {
        let start = Point { q: [0.0, 0.0], v: [1.0, 1.0] };
        let seen = run_of::<M, _>(&forced(lambda), start, &even(5000));
        let mut largest = 0.0f64;
        for (time, at) in &seen.shown {
            largest = largest.max((at.v[0] - time.cos()).abs()).max((at.q[0] - time.sin()).abs());
        }
        println!("{lambda:e}: {:.2} tolerances, {} steps", largest / TOLERANCE, seen.steps.len());
        assert!(largest < 3.0 * TOLERANCE, "{lambda:e}: {largest:e}");
    }
}

fn a_step_is_completed_up_to_the_end_of_the_equations<M: Known>() {
    let (mut control, mut counts) = (Control::new(1e-4), Statistics::default());
    let mut trajectory = Trajectory { end: f64::INFINITY, ..Trajectory::new(Logarithmic::exact(0.0), 0.0, STOP) };
    let mut completed = 0.0;
    for time in [0.7, 1.1, 1.100001, 2.0] {
        let mut go_to = |trajectory: &mut Trajectory<2, f64>| {
            let mut budget = 10_000;
            let (control, statistics) = (&mut control, &mut counts);
            let context = SolverContext { tolerance: TOLERANCE, control, statistics, budget: &mut budget };
            proceed(&M::METHOD, &Logarithmic, trajectory, time, context, |step| {
                completed += step.h;
                AfterStep::Continue
            })
            .unwrap();
        };
        go_to(&mut trajectory);
        let pending = trajectory.pending.as_ref().unwrap();
        let shown = trajectory.extension.at((time - trajectory.time) / pending.h);
        trajectory.end_at(time);
        go_to(&mut trajectory);
        assert!(trajectory.pending.is_none());
        assert_eq!((trajectory.time, trajectory.point), (time, shown));
        trajectory.end = f64::INFINITY;
    }
    assert!((completed - 2.0).abs() < 1e-14, "{completed}");
}

//! Tests of steps that are carried out, steps that are refused, and the state after a failed step.

use bevel_differential::fmi2::*;

use crate::common::{Host, assert_contains};

fn last_time(host: &Host) -> f64 {
    let mut time = f64::NAN;
    // SAFETY: a live component and memory for one value
    assert_eq!(unsafe { fmi2GetRealStatus(host.c, LAST_SUCCESSFUL_TIME, &mut time) }, Status::Ok);
    time
}

fn with_experiment(tolerance: Option<f64>, start: f64, stop: Option<f64>) -> (Host, Status) {
    let host = Host::new();
    let (defined, stops) = (i32::from(tolerance.is_some()), i32::from(stop.is_some()));
    // SAFETY: a live component
    let status =
        unsafe { fmi2SetupExperiment(host.c, defined, tolerance.unwrap_or(0.0), start, stops, stop.unwrap_or(0.0)) };
    (host, status)
}

#[test]
fn a_step_size_that_is_not_finite_and_positive_is_refused() {
    let host = Host::new();
    host.start();
    for h in [0.0, -1e-3, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(host.step(0.0, h), Status::Error);
        assert_contains(&host.last_message(), &["fmi2DoStep", &h.to_string()]);
    }
    host.steps(0.0, 1e-3, 1);
}

#[test]
fn communication_points_are_compared_with_a_tolerance() {
    let host = Host::new();
    host.start();
    // the sum of the steps differs from their multiple by rounding
    let mut t = 0.0;
    for _ in 0..1000 {
        assert_eq!(host.step(t, 1e-4), Status::Ok, "{:?}", host.log());
        t += 1e-4;
    }
    assert_eq!(host.step(t * (1.0 + 1e-12), 1e-4), Status::Ok);
    let now = last_time(&host);
    for wrong in [now + 1e-5, now - 1e-5, 0.0, f64::NAN, f64::INFINITY] {
        assert_eq!(host.step(wrong, 1e-4), Status::Error);
        assert_contains(&host.last_message(), &["communication point", &wrong.to_string(), &now.to_string()]);
    }
    assert_eq!(last_time(&host), now);
}

#[test]
fn a_repeated_or_omitted_step_is_refused_even_at_late_times() {
    for (start, h) in [(1e6, 1e-4), (1e3, 1e-6), (0.0, 1e-9)] {
        let (host, status) = with_experiment(None, start, None);
        assert_eq!((status, host.enter(), host.exit()), (Status::Ok, Status::Ok, Status::Ok));
        host.steps(start, h, 1);
        for wrong in [start, start + 3.0 * h] {
            assert_eq!(host.step(wrong, h), Status::Error, "{start} {h} {wrong}");
            assert_contains(&host.last_message(), &["communication point", "is not the current time"]);
        }
        assert_eq!(host.step(start + h, h), Status::Ok);
    }
}

#[test]
fn a_step_below_the_resolution_of_time_changes_nothing() {
    for level in [1, 3] {
        let host = Host::on_level(level);
        host.start();
        host.record_steps(0, 2);
        let before = host.outputs();
        assert_eq!(host.step(2e-3, 1e-25), Status::Ok);
        assert!(host.outputs() == before);
    }
}

#[test]
fn steps_end_at_the_stop_time_with_a_tolerance() {
    let (host, status) = with_experiment(None, 0.0, Some(0.3));
    assert_eq!([status, host.enter(), host.exit()], [Status::Ok; 3]);
    let mut t = 0.0;
    for _ in 0..3 {
        assert_eq!(host.step(t, 0.1), Status::Ok); // 0.1 + 0.1 + 0.1 > 0.3
        t += 0.1;
    }
    assert_eq!(host.step(t, 0.1), Status::Error);
    assert_contains(&host.last_message(), &["stop time", "0.3"]);
}

#[test]
fn an_invalid_experiment_is_refused() {
    for start in [f64::NAN, f64::INFINITY] {
        let (host, status) = with_experiment(None, start, None);
        assert_eq!(status, Status::Error);
        assert_contains(&host.last_message(), &["start time"]);
    }
    for stop in [0.0, f64::NAN] {
        let (host, status) = with_experiment(None, 1.0, Some(stop));
        assert_eq!(status, Status::Error);
        assert_contains(&host.last_message(), &["stop time"]);
    }
    for tolerance in [0.0, -1.0, f64::NAN] {
        assert_eq!(with_experiment(Some(tolerance), 0.0, None).1, Status::Error);
    }
}

#[test]
fn time_starts_at_the_start_time_of_the_experiment() {
    for start in [-3.0, 100.0] {
        let (host, status) = with_experiment(None, start, None);
        assert_eq!([status, host.enter(), host.exit()], [Status::Ok; 3]);
        assert_eq!(last_time(&host), start);
        assert_eq!(host.step(0.0, 1e-3), Status::Error);
        host.steps(start, 1e-3, 10);
    }
}

#[test]
fn the_experiment_sets_the_tolerance_within_its_range_unless_the_host_chose_one() {
    let tolerance = |host: &Host| host.get("solver.relative_tolerance");
    assert_eq!(tolerance(&with_experiment(Some(1e-4), 0.0, None).0), 1e-4);
    let range = bevel_differential::variables::table().rows
        [crate::common::reference("solver.relative_tolerance") as usize]
        .range
        .unwrap();
    assert_eq!(tolerance(&with_experiment(Some(1e-30), 0.0, None).0), range.min);
    assert_eq!(tolerance(&with_experiment(Some(1e30), 0.0, None).0), range.max);
    let host = Host::new();
    assert_eq!(host.set("solver.relative_tolerance", 1e-8), Status::Ok);
    // SAFETY: a live component
    assert_eq!(unsafe { fmi2SetupExperiment(host.c, 1, 1e-3, 0.0, 0, 0.0) }, Status::Ok);
    assert_eq!(tolerance(&host), 1e-8);
}

#[test]
fn a_failed_step_is_discarded_with_the_last_successful_time() {
    let host = Host::on_level(3);
    host.start();
    host.record_steps(0, 2);
    assert_eq!(host.set("left.load_torque", 1e7), Status::Ok);
    assert_eq!(host.step(2e-3, 1e-2), Status::Discard);
    let last = host.log().pop().unwrap();
    assert_eq!((last.status, last.category.as_str()), (Status::Discard, "logStatusDiscard"));
    assert_contains(&last.message, &["fmi2DoStep", "tooth deflection exceeds", "last successful time"]);
    let time = last_time(&host);
    assert!((2e-3..12e-3).contains(&time), "{time}");
    let six_digits: f64 = format!("{time:.5e}").parse().unwrap();
    assert_contains(&last.message, &[&format!("last successful time {six_digits:?} s")]);
    assert!(host.outputs().iter().all(|&bits| f64::from_bits(bits).is_finite()));
    let mut status = Status::Ok;
    // SAFETY: a live component and memory for one value
    assert_eq!(unsafe { fmi2GetStatus(host.c, DO_STEP_STATUS, &mut status) }, Status::Ok);
    assert_eq!(status, Status::Discard);
    assert_eq!(host.step(time, 1e-3), Status::Error, "only after a state is restored or a reset");
    assert_eq!(host.reset(), Status::Ok);
    host.start();
}

//! Tests of the tolerance and time interval announced by hosts. They survive restored states, and an interval may have
//! zero length.

use bevel_differential::fmi2::*;

use crate::common::{Host, assert_contains};

/// Creates and starts an instance of the study with teeth.
fn started(tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Host {
    let host = Host::on_level(3);
    announce(&host, tolerance, start, stop);
    assert_eq!([host.enter(), host.exit()], [Status::Ok; 2], "{:?}", host.log());
    host
}

fn announce(host: &Host, tolerance: Option<f64>, start: f64, stop: Option<f64>) {
    let defined = [tolerance.is_some(), stop.is_some()].map(i32::from);
    let (tolerance, stop) = (tolerance.unwrap_or(0.0), stop.unwrap_or(0.0));
    // SAFETY: a live component
    let status = unsafe { fmi2SetupExperiment(host.c, defined[0], tolerance, start, defined[1], stop) };
    assert_eq!(status, Status::Ok, "{:?}", host.log());
}

/// Copies the state of `from` to `to`, as bytes.
fn restore(from: &Host, to: &Host) {
    let state = from.get_state();
    let (status, copy) = to.deserialize(&from.serialize(state));
    assert_eq!([status, to.set_state(copy)], [Status::Ok; 2], "{:?}", to.log());
    to.free_state(copy);
    from.free_state(state);
}

/// Checks that a step from `time` beyond the stop time is refused.
fn refuses_beyond(host: &Host, time: f64, words: &[&str]) {
    assert_eq!(host.step(time, 1e-3), Status::Error);
    assert_contains(&host.last_message(), &["fmi2DoStep", "stop time"]);
    assert_contains(&host.last_message(), words);
}

#[test]
fn an_announced_stop_time_takes_precedence_over_a_restored_one() {
    let uncut = started(None, 0.0, Some(0.02));
    let expected = uncut.record_steps(0, 20);
    let first = started(None, 0.0, Some(0.01));
    assert!(first.record_steps(0, 10) == expected[..10]);
    // a stop time later than in the state, and an earlier one
    let second = started(None, 0.0, Some(0.02));
    restore(&first, &second);
    assert!(second.record_steps(10, 10) == expected[10..]);
    refuses_beyond(&second, 0.02, &["0.02 s"]);
    assert!(!second.last_message().contains("restored"), "{}", second.last_message());
    let early = started(None, 0.0, Some(0.005));
    restore(&first, &early);
    refuses_beyond(&early, 0.01, &["0.005 s"]);
    // also by pointer within the process
    let state = first.get_state();
    assert_eq!(second.set_state(state), Status::Ok);
    assert!(second.record_steps(10, 10) == expected[10..]);
    first.free_state(state);
}

#[test]
fn without_an_announced_stop_time_the_restored_one_applies_and_messages_say_so() {
    let (first, second) = (started(None, 0.0, Some(0.002)), started(None, 0.0, Some(0.003)));
    let steps = first.record_steps(0, 2);
    assert!(second.record_steps(0, 2) == steps);
    let other = started(None, 0.0, None);
    restore(&first, &other);
    refuses_beyond(&other, 0.002, &["0.002 s", "restored state", "fmi2SetupExperiment"]);
    // each state has its own stop time
    restore(&second, &other);
    other.record_steps(2, 1);
    refuses_beyond(&other, 0.003, &["0.003 s", "restored state"]);
    // a new instance has only the stop time of the state
    let fresh = Host::new();
    restore(&second, &fresh);
    fresh.record_steps(2, 1);
    refuses_beyond(&fresh, 0.003, &["restored state"]);
    // a state that is saved now contains the stop time of this instance
    let third = started(None, 0.0, Some(0.004));
    restore(&second, &third);
    restore(&third, &fresh);
    fresh.record_steps(2, 2);
    refuses_beyond(&fresh, 0.004, &["0.004 s"]);
    let endless = started(None, 0.0, None);
    restore(&endless, &third);
    third.record_steps(0, 4);
    refuses_beyond(&third, 0.004, &["0.004 s"]);
}

#[test]
fn a_reset_or_another_experiment_forgets_what_was_announced() {
    let first = started(None, 0.0, Some(0.002));
    first.record_steps(0, 2);
    let host = started(None, 0.0, Some(0.05));
    assert_eq!(host.reset(), Status::Ok);
    restore(&first, &host);
    refuses_beyond(&host, 0.002, &["restored state"]);
    let host = Host::new();
    announce(&host, None, 0.0, Some(0.05));
    announce(&host, None, 0.0, None);
    restore(&first, &host);
    refuses_beyond(&host, 0.002, &["restored state"]);
}

#[test]
fn an_announced_tolerance_takes_precedence_over_a_restored_one_unless_it_was_set_as_a_parameter() {
    let tolerance = |host: &Host| host.get("solver.relative_tolerance");
    let (loose, tight) = (started(Some(1e-3), 0.0, None), started(Some(1e-9), 0.0, None));
    for host in [&loose, &tight] {
        assert_eq!(host.set("left.load_torque", 700.0), Status::Ok);
        host.record_steps(0, 2);
    }
    let evaluations = |host: &Host| {
        let before = host.get("solver.rhs_calls");
        assert_eq!(host.set("left.load_torque", 400.0), Status::Ok);
        host.record_steps(2, 10);
        host.get("solver.rhs_calls") - before
    };
    let other = started(Some(1e-9), 0.0, None);
    restore(&loose, &other);
    assert_eq!(tolerance(&other), 1e-9);
    let [of_loose, of_other, of_tight] = [&loose, &other, &tight].map(evaluations);
    assert!(
        of_other > 2.0 * of_loose && (0.8..1.25).contains(&(of_other / of_tight)),
        "{of_loose} {of_other} {of_tight}"
    );
    // without an announcement, or with the same tolerance, the state stays as it is
    for own in [None, Some(1e-9)] {
        let other = started(own, 0.0, None);
        restore(&tight, &other);
        assert_eq!(tolerance(&other), 1e-9);
        assert!(
            other.record_steps(12, 3) == {
                let again = Host::new();
                restore(&tight, &again);
                again.record_steps(12, 3)
            }
        );
    }
    let chosen = Host::on_level(3);
    assert_eq!(chosen.set("solver.relative_tolerance", 1e-5), Status::Ok);
    chosen.start();
    let other = started(Some(1e-9), 0.0, None);
    restore(&chosen, &other);
    assert_eq!(tolerance(&other), 1e-5);
}

#[test]
fn an_announced_tolerance_also_applies_to_a_state_in_initialisation_mode() {
    let saved = Host::on_level(3);
    announce(&saved, Some(1e-4), 0.0, Some(0.1));
    assert_eq!(saved.enter(), Status::Ok);
    assert!(saved.get("left.speed").is_finite());
    let host = Host::on_level(3);
    announce(&host, Some(1e-8), 0.0, Some(0.2));
    restore(&saved, &host);
    assert_eq!(host.exit(), Status::Ok);
    assert!(host.record_steps(0, 5) == started(Some(1e-8), 0.0, Some(0.2)).record_steps(0, 5));
}

#[test]
fn a_run_may_have_zero_length() {
    for time in [0.0, 5.0, -3.0, 1.7e9] {
        let (host, longer) = (started(None, time, Some(time)), started(None, time, Some(time + 1.0)));
        assert!(host.outputs() == longer.outputs(), "the start is the same at {time} s");
        assert_eq!(host.get("left.shaft_torque"), host.get("left.load_torque"));
        refuses_beyond(&host, time, &[&format!("stop time {time} s")]);
        // the state can be saved, and continues in an instance with a later stop time
        restore(&host, &longer);
        assert_eq!(longer.step(time, 1e-3), Status::Ok);
        assert_eq!(host.terminate(), Status::Ok);
    }
    let exchange = Host::for_exchange();
    announce(&exchange, None, 2.0, Some(2.0));
    assert_eq!([exchange.enter(), exchange.exit()], [Status::Ok; 2]);
    exchange.update();
    assert_eq!(exchange.get("left.shaft_torque"), 835.0);
    assert_eq!(exchange.terminate(), Status::Ok);
}

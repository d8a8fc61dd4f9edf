//! Peak-to-peak values over mesh cycles, compared with dense recordings through the FMI calls. They must not depend on
//! communication steps.

use std::f64::consts::PI;

use crate::common::Host;
use bevel_differential::fmi2::Status;

/// Recorded outputs, each with the output of its peak-to-peak value.
const QUANTITIES: [[&str; 2]; 6] = [
    ["left.speed", "left.speed_peak_to_peak"],
    ["right.speed", "right.speed_peak_to_peak"],
    ["planet[1].left_transmission_error", "planet[1].left_transmission_error_peak_to_peak"],
    ["planet[1].right_transmission_error", "planet[1].right_transmission_error_peak_to_peak"],
    ["planet[2].left_transmission_error", "planet[2].left_transmission_error_peak_to_peak"],
    ["planet[2].right_transmission_error", "planet[2].right_transmission_error_peak_to_peak"],
];
/// Spin of the planets [rad/s]; a tooth passes in 26 ms.
const SPIN: f64 = 24.0;
/// Duration of two and a half cycles [s].
const STOP: f64 = 0.065;

/// Turn before its first step, with mesh history. `integers` are values of integer variables, and `switches` are
/// Boolean variables that are set to true. The `sign` −1 reverses speeds and loads.
fn turn(sign: f64, integers: &[(&str, i32)], switches: &[&str]) -> Host {
    let host = Host::new();
    for name in switches.iter().chain(&["effects.mesh_history"]) {
        assert_eq!(host.set_boolean(name, 1), Status::Ok);
    }
    assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
    for &(name, value) in integers {
        assert_eq!(host.set_integer(name, value), Status::Ok);
    }
    let names = ["carrier.speed_command", "spin.command", "left.load_torque", "right.load_torque"];
    assert_eq!(host.set_many(&names, &[sign * 16.65, sign * SPIN, sign * 400.0, sign * 400.0]), Status::Ok);
    host.start();
    host
}

fn peak_to_peak(host: &Host) -> [f64; 6] {
    QUANTITIES.map(|[_, name]| host.get(name))
}

/// Number of mesh cycles rolled, up to a constant.
fn rolled(host: &Host) -> f64 {
    0.5 * (host.get("left.angle") - host.get("right.angle")) * 16.0 / (2.0 * PI)
}

/// Changes the load every millisecond, if `varies`.
fn load(host: &Host, millisecond: usize, varies: bool) {
    if varies {
        let torque = 400.0 + 60.0 * (1.7 * millisecond as f64).sin();
        assert_eq!(host.set("left.load_torque", torque), Status::Ok);
    }
}

/// Runs up to [`STOP`] with `per` steps per millisecond.
fn run(host: &Host, per: usize, varies: bool) {
    for k in 0..(STOP * 1e3).round() as usize {
        load(host, k, varies);
        for i in 0..per {
            let [from, to] = [i, i + 1].map(|i| (k as f64 + i as f64 / per as f64) * 1e-3);
            assert_eq!(host.step(from, to - from), Status::Ok, "{:?}", host.log());
        }
    }
}

/// Peak-to-peak values over the last whole cycle of a recording in steps of a microsecond.
fn recorded(host: &Host, varies: bool) -> [f64; 6] {
    let read = || QUANTITIES.map(|[name, _]| host.get(name));
    let (begin, mut cycles) = (rolled(host), 0.0);
    let none = [[f64::INFINITY, f64::NEG_INFINITY]; 6];
    let (mut extremes, mut last) = (none, [0.0; 6]);
    let add = |extremes: &mut [[f64; 2]; 6], values: [f64; 6]| {
        for ([least, largest], value) in extremes.iter_mut().zip(values) {
            (*least, *largest) = (least.min(value), largest.max(value));
        }
    };
    add(&mut extremes, read());
    for k in 0..(STOP * 1e6).round() as usize {
        if k % 1000 == 0 {
            load(host, k / 1000, varies);
        }
        assert_eq!(host.step(k as f64 * 1e-6, 1e-6), Status::Ok, "{:?}", host.log());
        add(&mut extremes, read());
        let now = (rolled(host) - begin).abs().floor();
        if now > cycles {
            cycles = now;
            last = extremes.map(|[least, largest]| largest - least);
            extremes = none;
            add(&mut extremes, read());
        }
    }
    assert_eq!(cycles, 2.0);
    last
}

fn assert_close(found: [f64; 6], expected: [f64; 6], relative: f64) {
    for ((found, expected), [name, _]) in found.into_iter().zip(expected).zip(QUANTITIES) {
        assert!((found - expected).abs() <= relative * expected.abs(), "{name}: {found:e}, expected {expected:e}");
    }
}

#[test]
fn values_equal_those_of_a_recording_in_steps_of_a_microsecond() {
    for (varies, integers, switches) in [
        (false, &[][..], &[][..]),
        (true, &[][..], &[][..]),
        (false, &[("contact.law", 2)][..], &["effects.pin_compliance"][..]),
        // planets that differ
        (false, &[("geometry.planet_count", 4), ("tooth_errors.accuracy_grade", 7)][..], &["effects.tooth_errors"][..]),
    ] {
        let (dense, coarse) = (turn(1.0, integers, switches), turn(1.0, integers, switches));
        let expected = recorded(&dense, varies);
        println!("{varies} {integers:?} {switches:?}: {expected:?}");
        assert!(expected.iter().all(|&value| value > 0.0));
        assert_close(peak_to_peak(&dense), expected, 1e-3);
        run(&coarse, 1, varies);
        assert_close(peak_to_peak(&coarse), expected, 1e-3);
    }
}

#[test]
fn communication_steps_change_nothing() {
    for varies in [false, true] {
        let all: Vec<[f64; 6]> = [1, 10, 37]
            .map(|per| {
                let host = turn(1.0, &[], &[]);
                run(&host, per, varies);
                peak_to_peak(&host)
            })
            .to_vec();
        for other in &all[1..] {
            assert_close(*other, all[0], 1e-8);
        }
    }
    let [coarse, fine] = [1e-2, 1e-4].map(|h: f64| {
        let host = turn(1.0, &[], &[]);
        host.steps(0.0, h, (6e-2 / h).round() as usize);
        peak_to_peak(&host)
    });
    assert_close(fine, coarse, 1e-8);
}

#[test]
fn other_methods_agree_within_their_accuracy() {
    let host = turn(1.0, &[], &[]);
    run(&host, 1, false);
    let expected = peak_to_peak(&host);
    for method in [2, 3] {
        let host = turn(1.0, &[("solver.method", method)], &[]);
        run(&host, 100, false);
        let found = peak_to_peak(&host);
        println!("method {method}: {found:?}");
        assert_close(found, expected, if method == 2 { 0.1 } else { 1e-3 });
    }
}

#[test]
fn values_are_zero_before_a_whole_cycle_straight_ahead_and_without_the_effect() {
    let host = turn(1.0, &[], &[]);
    assert_eq!(peak_to_peak(&host), [0.0; 6]);
    host.steps(0.0, 1e-3, 25);
    assert_eq!(peak_to_peak(&host), [0.0; 6]);
    host.steps(25e-3, 1e-3, 3);
    assert!(peak_to_peak(&host).iter().all(|&value| value > 0.0));
    let straight = Host::new();
    assert_eq!(straight.set_boolean("effects.mesh_history", 1), Status::Ok);
    straight.start();
    straight.steps(0.0, 1e-3, 100);
    assert_eq!(peak_to_peak(&straight), [0.0; 6]);
    let off = turn(1.0, &[], &[]);
    assert_eq!(off.reset(), Status::Ok);
    assert_eq!(off.set_integer("scene.planet_spin", 2), Status::Ok);
    assert_eq!(off.set("spin.command", SPIN), Status::Ok);
    off.start();
    off.steps(0.0, 1e-3, 60);
    assert_eq!(peak_to_peak(&off), [0.0; 6]);
}

#[test]
fn the_motion_has_the_same_bits_with_and_without_the_effect() {
    let names =
        ["left.speed", "planet[2].spin_angle", "planet[1].left_transmission_error", "solver.steps", "heat.contact"];
    let [with, without] = [1, 0].map(|on| {
        let host = Host::new();
        assert_eq!(host.set_boolean("effects.mesh_history", on), Status::Ok);
        assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
        assert_eq!(host.set("spin.command", SPIN), Status::Ok);
        host.start();
        host.steps(0.0, 1e-3, 60);
        names.map(|name| host.get(name).to_bits())
    });
    assert_eq!(with, without);
}

#[test]
fn a_state_saved_within_a_cycle_continues_with_the_same_bits() {
    let host = turn(1.0, &[], &[]);
    host.steps(0.0, 1e-3, 37);
    let state = host.get_state();
    let bytes = host.serialize(state);
    let ends = |host: &Host| {
        for k in 37..65 {
            let t = f64::from(k) * 1e-3;
            assert_eq!(host.step(t, 1e-3), Status::Ok);
        }
        host.outputs()
    };
    let expected = ends(&host);
    assert!(peak_to_peak(&host).iter().all(|&value| value > 0.0));
    assert_eq!(host.set_state(state), Status::Ok);
    assert_eq!(ends(&host), expected);
    host.free_state(state);
    let other = Host::new();
    let (status, state) = other.deserialize(&bytes);
    assert_eq!((status, other.set_state(state)), (Status::Ok, Status::Ok), "{:?}", other.log());
    assert_eq!(ends(&other), expected);
    other.free_state(state);
    // a run after a reset equals the first one
    assert_eq!(other.reset(), Status::Ok);
    assert_eq!(other.set_boolean("effects.mesh_history", 1), Status::Ok);
    other.start();
    assert_eq!(peak_to_peak(&other), [0.0; 6]);
}

#[test]
fn states_of_another_format_are_refused_by_name() {
    let host = turn(1.0, &[], &[]);
    let state = host.get_state();
    let mut bytes = host.serialize(state);
    host.free_state(state);
    let own = bytes[8];
    bytes[8] += 1;
    assert_eq!(host.deserialize(&bytes).0, Status::Error);
    crate::common::assert_contains(
        &host.last_message(),
        &[&format!("format {}", own + 1), &format!("reads format {own}")],
    );
}

#[test]
fn in_model_exchange_there_is_no_history() {
    let host = Host::for_exchange();
    assert_eq!(host.set_boolean("effects.mesh_history", 1), Status::Ok);
    host.start_exchange();
    assert_eq!(peak_to_peak(&host), [0.0; 6]);
}

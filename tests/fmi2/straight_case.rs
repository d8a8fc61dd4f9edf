//! Tests of the study's straight case through the C functions. Expected values are the study's loads and speed, and
//! statics.

use bevel_differential::fmi2::Status;

use crate::common::Host;

const LOAD: f64 = 835.0; // N·m on each half-shaft
const SPEED: f64 = 2861.0 * std::f64::consts::PI / 180.0; // rad/s of the carrier

fn close(host: &Host, name: &str, expected: f64, tolerance: f64) {
    let value = host.get(name);
    assert!((value - expected).abs() <= tolerance, "{name} = {value}, expected {expected} within {tolerance}");
}

/// Checks that both wheels turn with the carrier, planets do not spin on their pins, and loads and drive are in
/// balance.
fn assert_straight(host: &Host, relative: f64) {
    for name in ["carrier.speed", "left.speed", "right.speed"] {
        close(host, name, SPEED, relative * SPEED);
    }
    for name in ["left.shaft_torque", "right.shaft_torque"] {
        close(host, name, LOAD, relative * LOAD);
    }
    close(host, "carrier.torque", 2.0 * LOAD, relative * 2.0 * LOAD);
    close(host, "power.in", 2.0 * LOAD * SPEED, relative * 2.0 * LOAD * SPEED);
    close(host, "power.out", 2.0 * LOAD * SPEED, relative * 2.0 * LOAD * SPEED);
    close(host, "efficiency", 1.0, relative);
    close(host, "planet[1].spin_speed", 0.0, relative * SPEED);
    close(host, "planet[3].spin_speed", 0.0, 0.0);
}

#[test]
fn outputs_are_right_at_time_zero_before_and_after_the_end_of_initialisation() {
    for level in [1, 3] {
        let host = Host::new();
        host.set_integer("scene.gear_contact", level);
        assert_eq!(host.setup(), Status::Ok);
        assert_eq!(host.enter(), Status::Ok);
        assert_straight(&host, 1e-3);
        let before = host.outputs();
        assert_eq!(host.exit(), Status::Ok);
        assert_eq!(host.outputs(), before, "level {level}");
    }
}

#[test]
fn outputs_in_initialisation_mode_follow_the_values_set() {
    let host = Host::new();
    host.set_integer("scene.gear_contact", 1);
    assert_eq!(host.enter(), Status::Ok, "without fmi2SetupExperiment the start time is 0");
    for load in [100.0, 200.0] {
        assert_eq!(host.set_many(&["left.load_torque", "right.load_torque"], &[load, load]), Status::Ok);
        close(&host, "carrier.torque", 2.0 * load, 1e-9 * load);
    }
}

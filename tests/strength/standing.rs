//! Fatigue of teeth in mesh that do not roll: both roots of a tooth count, each with the tension of its own flank.

use crate::common::Host;
use std::f64::consts::PI;

const SPEED: f64 = 2861.0 * PI / 180.0;
/// Duration of a pulse [s].
const PULSE: f64 = 0.02;
const STEP: f64 = 5e-4;
const PULSES: u32 = 6;

/// Root damage [planet, side gear] after smooth pulses of the load torques from `low` to `high` [N·m] on both sides.
fn pulses(settings: &[(&str, i32)], speed: f64, [low, high]: [f64; 2]) -> [f64; 2] {
    let host = Host::new();
    host.set_boolean("effects.strength", 1);
    for &(name, value) in settings {
        host.set_integer(name, value);
    }
    host.set("carrier.speed_command", speed);
    let load = |t: f64| {
        let torque = low + (high - low) * (PI * t / PULSE).sin().powi(2);
        host.set_many(&["left.load_torque", "right.load_torque"], &[torque; 2]);
    };
    load(0.0);
    host.start();
    let steps = (f64::from(PULSES) * PULSE / STEP).round() as usize;
    for i in 0..steps {
        load(i as f64 * STEP);
        host.steps(i as f64 * STEP, STEP, 1);
    }
    ["damage.planet", "damage.side"].map(|name| host.get(name))
}

fn close(program: f64, expected: f64, relative: f64) {
    assert!((program / expected - 1.0).abs() <= relative, "program {program:e}, expected {expected:e}");
}

const LAWS: [(&str, i32); 3] = [("contact.law", 1), ("contact.law", 2), ("contact.law", 3)];

#[test]
fn pulses_of_overrun_do_the_damage_of_pulses_of_drive() {
    for law in LAWS {
        let drive = pulses(&[law], SPEED, [50.0, 900.0]);
        let coast = pulses(&[law], SPEED, [-50.0, -900.0]);
        println!("{law:?}: drive {drive:?}, coast {coast:?}");
        assert!(drive[0] > 1e-8 && drive[1] > 1e-8, "{drive:?}");
        for i in 0..2 {
            close(coast[i], drive[i], 0.03);
        }
    }
}

#[test]
fn reversals_damage_a_root_that_does_not_roll_more_than_pulses_of_either_sign() {
    // at equal peaks, the compression from the other flank widens the cycle of both roots
    let pulsating = pulses(&[LAWS[1]], SPEED, [0.0, 700.0]);
    let alternating = pulses(&[LAWS[1]], SPEED, [-700.0, 700.0]);
    println!("{pulsating:?} {alternating:?}");
    assert!(alternating[0] > 3.0 * pulsating[0] && alternating[1] > 3.0 * pulsating[1]);
}

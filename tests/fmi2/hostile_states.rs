//! Tests of saved states with absurd numbers. Each state must be refused with a message, or the run from it must be
//! finite.

use bevel_differential::fmi2::*;
use bevel_differential::variables::fnv1a;

use crate::common::Host;

/// Number of bytes before the payload: magic, version, hash of the GUID, length.
const HEADER: usize = 28;
/// Number of bytes of the checksum after the payload.
const CHECKSUM: usize = 8;
/// Values that replace each number.
const ABSURD: [f64; 6] = [f64::NAN, f64::INFINITY, 1e300, -1e300, -1.0, 1e20];

/// Positions of possible numbers in a payload: any eight bytes that form a number of ordinary magnitude, and zeros at
/// intervals of eight bytes.
fn positions(bytes: &[u8]) -> Vec<usize> {
    let mut positions = Vec::new();
    let mut zeros_until = 0;
    for position in HEADER..=bytes.len() - CHECKSUM - 8 {
        let window: [u8; 8] = bytes[position..position + 8].try_into().unwrap();
        let number = f64::from_le_bytes(window);
        if window == [0; 8] {
            if position >= zeros_until {
                positions.push(position);
                zeros_until = position + 8;
            }
        } else if (1e-15..1e15).contains(&number.abs()) || !number.is_finite() {
            positions.push(position);
        }
    }
    positions
}

/// Returns `bytes` with `value` in place of the eight bytes at `position`, and a valid checksum.
fn poisoned(bytes: &[u8], position: usize, value: f64) -> Vec<u8> {
    let mut poisoned = bytes.to_vec();
    poisoned[position..position + 8].copy_from_slice(&value.to_le_bytes());
    let end = bytes.len() - CHECKSUM;
    let sum = fnv1a(poisoned[..end].iter().copied());
    poisoned[end..].copy_from_slice(&sum.to_le_bytes());
    poisoned
}

/// Runs from a state of `bytes` at `time` [s]. Returns true if all results are finite, and false if the state is
/// refused with a message. The error describes any other outcome.
fn run(host: &Host, bytes: &[u8], time: f64) -> Result<bool, String> {
    host.clear_log();
    let refused = || {
        let said = host.last_message();
        if said.is_empty() || said.contains("internal error") {
            Err(format!("refused with \"{said}\""))
        } else {
            Ok(false)
        }
    };
    let (status, state) = host.deserialize(bytes);
    if status != Status::Ok {
        return refused();
    }
    let restored = host.set_state(state);
    host.free_state(state);
    if restored != Status::Ok {
        return refused();
    }
    for k in 0..2 {
        let h = 1e-5;
        if host.step(time + f64::from(k) * h, h) != Status::Ok {
            return refused();
        }
        for name in
            ["left.speed", "left.normal_force", "temperature.oil", "heat.contact", "damage.planet", "torque_bias_ratio"]
        {
            let (status, value) = host.try_get(name);
            if status != Status::Ok || !value.is_finite() {
                return Err(format!("{name} = {value}: {}", host.last_message()));
            }
        }
    }
    Ok(true)
}

/// Replaces each number in the state of `host`, which is at `time` [s], with each absurd value.
fn poison(host: &Host, time: f64) {
    let state = host.get_state();
    let bytes = host.serialize(state);
    host.free_state(state);
    assert_eq!(run(host, &bytes, time), Ok(true));
    let (mut refused, mut accepted, mut bad) = (0, 0, Vec::new());
    for position in positions(&bytes) {
        for value in ABSURD {
            match run(host, &poisoned(&bytes, position, value), time) {
                Ok(true) => accepted += 1,
                Ok(false) => refused += 1,
                Err(what) => bad.push(format!("{value} at byte {position}: {what}")),
            }
        }
    }
    assert!(bad.is_empty(), "{} of {} bytes: {:#?}", bad.len(), bytes.len(), &bad[..bad.len().min(20)]);
    assert!(refused > 500 && accepted > 100, "{refused} refused, {accepted} accepted");
}

#[test]
fn absurd_numbers_in_a_state_with_teeth_are_refused_or_harmless() {
    let host = Host::on_level(3);
    for switch in ["strength", "mesh_history", "half_shaft", "warm_up", "limited_slip", "wheel_brake"] {
        assert_eq!(host.set_boolean(&format!("effects.{switch}"), 1), Status::Ok);
    }
    assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
    assert_eq!(host.set_many(&["spin.command", "left.brake_torque"], &[20.0, 50.0]), Status::Ok);
    host.start();
    // a tooth has passed, and a step of the solver is pending
    host.steps(0.0, 1e-3, 60);
    poison(&host, 60e-3);
}

#[test]
fn absurd_numbers_in_a_state_without_teeth_are_refused_or_harmless() {
    let host = Host::on_level(1);
    for switch in ["warm_up", "wheel_brake", "bearing_drag"] {
        assert_eq!(host.set_boolean(&format!("effects.{switch}"), 1), Status::Ok);
    }
    assert_eq!(host.set("right.brake_torque", 50.0), Status::Ok);
    host.start();
    host.steps(0.0, 1e-3, 5);
    poison(&host, 5e-3);
}

#[test]
fn a_stop_time_that_is_not_a_number_or_before_the_start_is_refused() {
    let host = Host::on_level(1);
    // SAFETY: a live component
    assert_eq!(unsafe { fmi2SetupExperiment(host.c, 0, 0.0, 0.25, 1, 0.75) }, Status::Ok);
    assert_eq!([host.enter(), host.exit()], [Status::Ok; 2]);
    let state = host.get_state();
    let bytes = host.serialize(state);
    host.free_state(state);
    let stop = 0.75f64.to_le_bytes();
    let position = bytes.windows(8).rposition(|window| window == stop).expect("the stop time is saved");
    for bad in [f64::NAN, 0.125, f64::NEG_INFINITY] {
        assert_eq!(host.deserialize(&poisoned(&bytes, position, bad)).0, Status::Error, "{bad}");
    }
}

//! Tests of FMU states: a restored simulation continues bit by bit, and invalid bytes are refused.

use std::ptr;

use bevel_differential::fmi2::*;

use crate::common::{Host, assert_contains};

#[test]
fn a_restored_state_continues_bit_by_bit() {
    for level in [1, 3] {
        let host = Host::on_level(level);
        host.start();
        host.record_steps(0, 5);
        let state = host.get_state();
        let expected = host.record_steps(5, 10);
        assert_eq!(host.set_state(state), Status::Ok);
        assert!(host.record_steps(5, 10) == expected, "level {level}");
        // a state can be restored repeatedly, and overwritten
        assert_eq!(host.set_state(state), Status::Ok);
        assert!(host.record_steps(5, 3) == expected[..3]);
        let mut reused = state;
        // SAFETY: a live component and a live state
        assert_eq!(unsafe { fmi2GetFMUstate(host.c, &mut reused) }, Status::Ok);
        assert_eq!(reused, state);
        let later = host.record_steps(8, 7);
        assert!(later == expected[3..]);
        assert_eq!(host.set_state(state), Status::Ok);
        assert!(host.record_steps(8, 7) == later);
        host.free_state(state);
    }
}

/// Creates another instance in the serialised state `bytes`, and checks that it serialises to the same bytes.
fn another_instance(bytes: &[u8]) -> Host {
    let other = Host::new();
    let (status, copy) = other.deserialize(bytes);
    assert_eq!(status, Status::Ok, "{:?}", other.log());
    assert_eq!(other.serialize(copy), bytes);
    assert_eq!(other.set_state(copy), Status::Ok);
    other.free_state(copy);
    other
}

#[test]
fn a_serialised_state_continues_bit_by_bit_in_another_instance() {
    for level in [1, 3] {
        let host = Host::on_level(level);
        host.start();
        host.record_steps(0, 5);
        assert_eq!(host.set("contact.damping", 7e4), Status::Ok, "tunable, so part of the state");
        let state = host.get_state();
        let bytes = host.serialize(state);
        let expected_now = host.outputs();
        let expected = host.record_steps(5, 10);
        host.free_state(state);

        let other = another_instance(&bytes);
        assert_eq!(other.get_integer("scene.gear_contact"), level);
        assert!(other.outputs() == expected_now);
        assert!(other.record_steps(5, 10) == expected, "level {level}");
    }
}

#[test]
fn a_state_within_a_step_of_the_solver_continues_bit_by_bit() {
    let host = Host::on_level(3);
    host.start();
    // inputs are held, so steps of the solver grow much longer than these steps
    let go_on = |host: &Host, first: usize| {
        (first..first + 40)
            .map(|i| {
                assert_eq!(host.step(i as f64 * 1e-4, 1e-4), Status::Ok, "{:?}", host.log());
                host.outputs()
            })
            .collect::<Vec<_>>()
    };
    go_on(&host, 0);
    let steps = host.get("solver.steps");
    go_on(&host, 40);
    assert!(host.get("solver.steps") - steps < 30.0, "a step contains several points");
    let state = host.get_state();
    let bytes = host.serialize(state);
    let expected = go_on(&host, 80);
    assert_eq!(host.set_state(state), Status::Ok);
    assert!(go_on(&host, 80) == expected);
    host.free_state(state);
    assert!(go_on(&another_instance(&bytes), 80) == expected);
}

#[test]
fn states_of_every_phase_can_be_stored_and_restored() {
    let host = Host::on_level(3);
    let before = host.get_state();
    host.start();
    let expected = host.record_steps(0, 3);
    assert_eq!(host.terminate(), Status::Ok);
    let after = host.get_state();
    for state in [before, after] {
        let (status, copy) = host.deserialize(&host.serialize(state));
        assert_eq!(status, Status::Ok, "{:?}", host.log());
        host.free_state(copy);
    }
    assert_eq!(host.set_state(before), Status::Ok);
    assert_eq!(host.get("inertia.left_end"), 0.5);
    host.start();
    assert!(host.record_steps(0, 3) == expected);
    assert_eq!(host.set_state(after), Status::Ok);
    assert_eq!(host.step(3e-3, 1e-3), Status::Error, "terminated again");
    host.free_state(before);
    host.free_state(after);
}

#[test]
fn damaged_truncated_and_foreign_bytes_are_refused_and_change_nothing() {
    let host = Host::on_level(3);
    host.start();
    host.record_steps(0, 2);
    let state = host.get_state();
    let bytes = host.serialize(state);
    let refuse = |bytes: &[u8], words: &[&str]| {
        let (status, made) = host.deserialize(bytes);
        assert_eq!(status, Status::Error);
        assert!(made.is_null());
        assert_contains(&host.last_message(), &["fmi2DeSerializeFMUstate"]);
        assert_contains(&host.last_message(), words);
    };
    for length in 0..bytes.len() {
        refuse(&bytes[..length], &["truncated"]);
    }
    for i in 0..bytes.len() {
        for bit in 0..8 {
            let mut damaged = bytes.clone();
            damaged[i] ^= 1 << bit;
            refuse(&damaged, &[]);
        }
    }
    let changed = |at: usize, by: u8| {
        let mut changed = bytes.clone();
        changed[at] ^= by;
        changed
    };
    refuse(&changed(0, 1), &["not a serialised state"]);
    refuse(&changed(8, 1), &[&format!("format {}", bytes[8] ^ 1)]);
    refuse(&changed(12, 1), &["another version"]);
    refuse(&changed(bytes.len() / 2, 1), &["checksum"]);
    refuse(&[bytes.as_slice(), &[0]].concat(), &["surplus bytes"]);
    refuse(&vec![0; bytes.len()], &["not a serialised state"]);

    // refused bytes do not change an existing state
    let mut kept = state;
    // SAFETY: a live component, the bytes, a live state
    let status = unsafe { fmi2DeSerializeFMUstate(host.c, bytes.as_ptr().cast(), bytes.len() - 1, &mut kept) };
    assert_eq!((status, kept), (Status::Error, state));
    assert_eq!(host.serialize(state), bytes);
    let expected = host.record_steps(2, 2);
    assert_eq!(host.set_state(state), Status::Ok);
    assert!(host.record_steps(2, 2) == expected);
    host.free_state(state);
}

#[test]
fn a_wrong_size_and_null_pointers_are_refused() {
    let host = Host::new();
    host.start();
    let state = host.get_state();
    let mut bytes = host.serialize(state);
    let (short, long) = (bytes.len() - 1, bytes.len() + 1);
    bytes.extend([0; 8]);
    // SAFETY: a live component; memory of these sizes; NULL is the object of the test
    unsafe {
        assert_eq!(fmi2SerializeFMUstate(host.c, state, bytes.as_mut_ptr().cast(), short), Status::Error);
        assert_eq!(fmi2SerializeFMUstate(host.c, state, bytes.as_mut_ptr().cast(), long), Status::Error);
        assert_contains(&host.last_message(), &[&long.to_string(), &(long - 1).to_string()]);
        assert_eq!(fmi2SerializeFMUstate(host.c, state, ptr::null_mut(), long - 1), Status::Error);
        assert_eq!(fmi2SerializedFMUstateSize(host.c, ptr::null_mut(), &mut 0), Status::Error);
        assert_eq!(fmi2SerializedFMUstateSize(host.c, state, ptr::null_mut()), Status::Error);
        assert_eq!(fmi2GetFMUstate(host.c, ptr::null_mut()), Status::Error);
        assert_eq!(fmi2SetFMUstate(host.c, ptr::null_mut()), Status::Error);
        assert_eq!(fmi2DeSerializeFMUstate(host.c, ptr::null(), 10, &mut ptr::null_mut()), Status::Error);
        assert_eq!(fmi2FreeFMUstate(host.c, &mut ptr::null_mut()), Status::Ok);
    }
    host.free_state(state);
}

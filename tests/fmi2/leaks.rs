//! No leaks: ten thousand instances, states and refused calls leave the live bytes of the heap unchanged.

use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::variables::guid;

use crate::common::counting_allocator::live_bytes;
use crate::common::{Host, reference};

const MANY: usize = 10_000;

/// Bytes that `MANY` runs of `once` leave allocated, after some runs that initialise what a process needs only once.
fn left_behind(mut once: impl FnMut(usize)) -> isize {
    (0..8).for_each(&mut once);
    let before = live_bytes();
    (0..MANY).for_each(once);
    live_bytes() - before
}

/// An instance without a log, which would grow.
fn silent(kind: i32) -> ComponentPointer {
    let guid = std::ffi::CString::new(guid()).unwrap();
    // SAFETY: strings that live through the call; no callbacks
    let c = unsafe { fmi2Instantiate(c"leak".as_ptr(), kind, guid.as_ptr(), ptr::null(), ptr::null(), 0, 0) };
    assert!(!c.is_null());
    c
}

#[test]
fn ten_thousand_instances_leave_nothing_behind() {
    let (level, module) = (reference("scene.gear_contact"), reference("geometry.module"));
    let left = left_behind(|i| {
        let c = silent(i as i32 % 2);
        // every fourth is not initialised, every fourth fails to initialise
        // SAFETY: a live component, one value each
        unsafe {
            if i % 4 > 0 {
                fmi2SetInteger(c, &level, 1, &(1 + i as i32 / 2 % 3));
                let value = if i % 4 == 1 { 4.5 } else { 0.0045 };
                assert_eq!(fmi2SetReal(c, &module, 1, &value), Status::Ok);
                assert_eq!(fmi2EnterInitializationMode(c), Status::Ok);
                let begun = fmi2ExitInitializationMode(c);
                assert_eq!(begun, if i % 4 == 1 { Status::Error } else { Status::Ok });
                if i % 2 == 1 && begun == Status::Ok {
                    assert_eq!(fmi2DoStep(c, 0.0, 1e-4, 1), Status::Ok);
                }
            }
            fmi2FreeInstance(c);
        }
    });
    assert_eq!(left, 0);
}

#[test]
fn ten_thousand_states_leave_nothing_behind() {
    for kind in [MODEL_EXCHANGE, CO_SIMULATION] {
        let c = silent(kind);
        // SAFETY: live component and states, and memory of these sizes
        unsafe {
            assert_eq!([fmi2EnterInitializationMode(c), fmi2ExitInitializationMode(c)], [Status::Ok; 2]);
            let left = left_behind(|i| {
                let (mut state, mut copy, mut size) = (ptr::null_mut(), ptr::null_mut(), 0);
                assert_eq!(fmi2GetFMUstate(c, &mut state), Status::Ok);
                assert_eq!(fmi2GetFMUstate(c, &mut state), Status::Ok);
                assert_eq!(fmi2SetFMUstate(c, state), Status::Ok);
                if i % 16 == 0 {
                    assert_eq!(fmi2SerializedFMUstateSize(c, state, &mut size), Status::Ok);
                    let mut bytes = vec![0u8; size];
                    assert_eq!(fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr().cast(), size), Status::Ok);
                    assert_eq!(fmi2DeSerializeFMUstate(c, bytes.as_ptr().cast(), size, &mut copy), Status::Ok);
                    // deserialised into an existing state, and refused
                    assert_eq!(fmi2DeSerializeFMUstate(c, bytes.as_ptr().cast(), size, &mut copy), Status::Ok);
                    bytes[size / 2] ^= 1;
                    assert_eq!(fmi2DeSerializeFMUstate(c, bytes.as_ptr().cast(), size, &mut copy), Status::Error);
                    assert_eq!(fmi2FreeFMUstate(c, &mut copy), Status::Ok);
                }
                assert_eq!(fmi2FreeFMUstate(c, &mut state), Status::Ok);
            });
            assert_eq!(left, 0);
            fmi2FreeInstance(c);
        }
    }
}

#[test]
fn ten_thousand_initialisations_of_one_instance_leave_nothing_behind() {
    let (module, c) = (reference("geometry.module"), silent(CO_SIMULATION));
    let left = left_behind(|i| {
        // SAFETY: a live component, one value
        unsafe {
            let value = if i % 8 == 0 { 0.0045 } else { 4.5 };
            assert_eq!(fmi2SetReal(c, &module, 1, &value), Status::Ok);
            assert_eq!(fmi2EnterInitializationMode(c), Status::Ok);
            assert_eq!(fmi2ExitInitializationMode(c), if i % 8 == 0 { Status::Ok } else { Status::Error });
            assert_eq!(fmi2Reset(c), Status::Ok);
        }
    });
    // SAFETY: a live component, the last use of it
    unsafe { fmi2FreeInstance(c) };
    assert_eq!(left, 0);
}

#[test]
fn a_leak_is_detected() {
    let host = Host::new();
    let mut states = Vec::with_capacity(MANY + 8);
    let left = left_behind(|_| states.push(host.get_state()));
    assert!(left >= (MANY * 100) as isize, "{left} bytes");
    states.into_iter().for_each(|state| host.free_state(state));
}

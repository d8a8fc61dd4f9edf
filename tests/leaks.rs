//! Tests for leaks. Ten thousand instances, states and refused calls leave the live bytes of the heap unchanged. The
//! cache that instances share is freed with the last instance.
//!
//! This is a separate program that runs one test at a time, because all instances of a program share a cache.

mod common;

use std::ptr;
use std::sync::{Mutex, MutexGuard, PoisonError};

use bevel_differential::fmi2::*;
use bevel_differential::variables::guid;

use common::counting_allocator::{CountingAllocator, allocated_bytes, live_bytes};
use common::{Host, reference};

/// Allocator with counters per thread.
#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

const MANY: usize = 10_000;

/// Lock held by the running test.
fn lock() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Number of bytes that `MANY` runs of `once` leave allocated. Some runs before them initialise what a process needs
/// only once.
fn left_behind(mut once: impl FnMut(usize)) -> isize {
    (0..8).for_each(&mut once);
    let before = live_bytes();
    (0..MANY).for_each(once);
    live_bytes() - before
}

/// Creates an instance without a log, because a log would grow.
fn silent(kind: i32) -> ComponentPointer {
    let guid = std::ffi::CString::new(guid()).unwrap();
    // SAFETY: the strings outlive the call; no callbacks
    let c = unsafe { fmi2Instantiate(c"leak".as_ptr(), kind, guid.as_ptr(), ptr::null(), ptr::null(), 0, 0) };
    assert!(!c.is_null());
    c
}

#[test]
fn ten_thousand_instances_leave_nothing_behind() {
    let _lock = lock();
    let (level, module) = (reference("scene.gear_contact"), reference("geometry.module"));
    let left = left_behind(|i| {
        let c = silent(i as i32 % 2);
        // one instance in four is not initialised, and one in four fails to initialise
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
    let _lock = lock();
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
    let _lock = lock();
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
    // SAFETY: a live component, used for the last time
    unsafe { fmi2FreeInstance(c) };
    assert_eq!(left, 0);
}

#[test]
fn a_leak_is_detected() {
    let _lock = lock();
    let host = Host::new();
    let mut states = Vec::with_capacity(MANY + 8);
    let left = left_behind(|_| states.push(host.get_state()));
    assert!(left >= (MANY * 100) as isize, "{left} bytes");
    states.into_iter().for_each(|state| host.free_state(state));
}

/// Initialises `c` with `module` [m] and with teeth whose stiffness follows from their geometry.
fn initialise(c: ComponentPointer, module: f64) {
    let (law, place) = (reference("contact.law"), reference("geometry.module"));
    // SAFETY: a live component, one value each
    let statuses = unsafe {
        [
            fmi2SetInteger(c, &law, 1, &2),
            fmi2SetReal(c, &place, 1, &module),
            fmi2EnterInitializationMode(c),
            fmi2ExitInitializationMode(c),
        ]
    };
    assert_eq!(statuses, [Status::Ok; 4]);
}

fn free(c: ComponentPointer) {
    // SAFETY: a live component, used for the last time
    unsafe { fmi2FreeInstance(c) };
}

const MODULE: f64 = 0.0045;

#[test]
fn instances_share_a_cache_and_the_last_one_frees_it() {
    let _lock = lock();
    let new = || {
        let c = silent(CO_SIMULATION);
        initialise(c, MODULE);
        c
    };
    free(new());
    let before = live_bytes();
    let first = new();
    let alone = live_bytes() - before;
    let second = new();
    let more = live_bytes() - before - alone;
    assert!(4 * more < alone, "{alone} bytes, then {more}");
    free(first);
    let third = new();
    assert_eq!(live_bytes() - before, alone + more);
    free(second);
    free(third);
    assert_eq!(live_bytes(), before);
}

#[test]
fn a_reset_keeps_cached_results_of_the_geometry() {
    let _lock = lock();
    let c = silent(CO_SIMULATION);
    let allocated = |module: f64| {
        let before = allocated_bytes();
        initialise(c, module);
        // SAFETY: a live component
        assert_eq!(unsafe { fmi2Reset(c) }, Status::Ok);
        allocated_bytes() - before
    };
    let [first, again, other, back] = [MODULE, MODULE, 1.01 * MODULE, MODULE].map(allocated);
    assert!(4 * again < first && 4 * again < other && back == again, "{first} {again} {other} {back}");
    free(c);
}

#[test]
fn only_a_few_of_many_geometries_are_cached() {
    let _lock = lock();
    let (c, before) = (silent(CO_SIMULATION), live_bytes());
    let after = |geometries: std::ops::Range<usize>| {
        for i in geometries {
            initialise(c, MODULE * (1.0 + 1e-4 * i as f64));
            // SAFETY: a live component
            assert_eq!(unsafe { fmi2Reset(c) }, Status::Ok);
        }
        live_bytes() - before
    };
    let [few, many, more] = [0..4, 4..40, 40..100].map(after);
    assert!(many < 5 * few, "{few} {many}");
    assert!((more - many).abs() < few / 4, "{few} {many} {more}");
    free(c);
}

#[test]
fn instances_of_many_threads_leave_nothing_behind() {
    let _lock = lock();
    let run = |thread: usize| {
        let before = live_bytes();
        for i in 0..24 {
            let held = silent(CO_SIMULATION);
            initialise(held, MODULE * (1.0 + 1e-3 * ((thread + i) % 6) as f64));
            free(held);
        }
        live_bytes() - before
    };
    // this run initialises what a process and its threads need only once
    run(0);
    let left: isize = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|thread| scope.spawn(move || run(thread))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).sum()
    });
    assert_eq!(left, 0);
}

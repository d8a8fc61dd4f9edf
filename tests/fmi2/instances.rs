//! Tests of instances: their creation, their number, and their threads.

use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::variables;

use crate::common::recorder::Recorder;
use crate::common::{Host, assert_contains};

/// Returns a pointer to `value` at an odd address, which is valid as long as `memory`.
fn misaligned<T: Copy>(memory: &mut Vec<u8>, value: T) -> *const T {
    memory.resize(size_of::<T>() + 1, 0);
    let pointer = memory.as_mut_ptr();
    let odd = pointer.wrapping_add(usize::from(pointer.addr().is_multiple_of(2))).cast::<T>();
    // SAFETY: the memory has one byte more than the value
    unsafe { odd.write_unaligned(value) };
    odd
}

#[test]
fn misaligned_callbacks_are_refused() {
    let recorder = Recorder::default();
    let guid = std::ffi::CString::new(variables::guid()).unwrap();
    let (callbacks, mut memory) = (recorder.callbacks(), Vec::new());
    let odd = misaligned(&mut memory, callbacks);
    // SAFETY: all arguments are valid during the calls, except for the alignment that is tested
    unsafe {
        assert!(fmi2Instantiate(c"test".as_ptr(), 1, guid.as_ptr(), ptr::null(), odd, 0, 1).is_null());
        let c = fmi2Instantiate(c"test".as_ptr(), 1, guid.as_ptr(), ptr::null(), &callbacks, 0, 1);
        assert!(!c.is_null());
        fmi2FreeInstance(c);
    }
}

#[test]
fn a_wrong_guid_is_refused_with_both_guids_in_the_log() {
    let wrong = "{8c4e810f-3df3-4a00-8276-176fa3c9f000}";
    let host = Host::instantiate(Some("test"), CO_SIMULATION, Some(wrong), None);
    assert!(host.c.is_null());
    assert_contains(&host.last_message(), &["fmi2Instantiate", wrong, variables::guid()]);
    let host = Host::instantiate(Some("test"), CO_SIMULATION, None, None);
    assert!(host.c.is_null());
    assert_contains(&host.last_message(), &["NULL", variables::guid()]);
}

#[test]
fn a_missing_name_and_unknown_kinds_are_refused() {
    for name in [None, Some("")] {
        let host = Host::instantiate(name, CO_SIMULATION, Some(variables::guid()), None);
        assert!(host.c.is_null());
        assert_contains(&host.last_message(), &["name"]);
    }
    for kind in [2, 3, -1, i32::MAX] {
        let host = Host::instantiate(Some("test"), kind, Some(variables::guid()), None);
        assert!(host.c.is_null());
        assert_contains(&host.last_message(), &["co-simulation", "model exchange"]);
    }
}

#[test]
fn any_resource_location_is_accepted() {
    let locations =
        ["", "file:///p%20q/resources", "file:/p", "file://localhost/p", "C:\\p", "https://example.org", "\u{fc}"];
    for location in [None].into_iter().chain(locations.map(Some)) {
        let host = Host::instantiate(Some("test"), CO_SIMULATION, Some(variables::guid()), location);
        assert!(!host.c.is_null(), "{location:?}");
        assert_eq!(host.enter(), Status::Ok);
    }
}

#[test]
fn a_thousand_instances_at_the_same_time_give_the_same_results() {
    let plain = Host::on_level(3);
    plain.start();
    let expected = plain.record_steps(0, 1);
    let hosts: Vec<_> = (0..1000).map(|_| Host::on_level(3)).collect();
    hosts.iter().for_each(Host::start);
    for host in &hosts {
        assert!(host.record_steps(0, 1) == expected);
    }
}

#[test]
fn eight_threads_with_small_stacks_give_the_same_results() {
    for level in [1, 3] {
        let run = move || {
            let host = Host::on_level(level);
            host.start();
            let state = host.get_state();
            let bytes = host.serialize(state);
            let (status, copy) = host.deserialize(&bytes);
            assert_eq!(status, Status::Ok);
            assert_eq!(host.set("left.load_torque", f64::NAN), Status::Discard);
            host.free_state(state);
            host.free_state(copy);
            host.record_steps(0, 20)
        };
        let expected = run();
        let spawn = |_| std::thread::Builder::new().stack_size(128 * 1024).spawn(run).unwrap();
        let threads: Vec<_> = (0..8).map(spawn).collect();
        for thread in threads {
            assert!(thread.join().unwrap() == expected, "level {level}");
        }
    }
}

#[test]
fn an_instance_may_move_from_thread_to_thread() {
    let plain = Host::on_level(3);
    plain.start();
    let expected = plain.record_steps(0, 4);
    let host = Host::on_level(3);
    host.start();
    let mut seen = host.record_steps(0, 2);
    struct Moved(Host);
    // SAFETY: only one thread at a time uses the host, because of the join below
    unsafe impl Send for Moved {}
    let moved = Moved(host);
    seen.extend(
        std::thread::spawn(move || {
            let whole = moved;
            whole.0.record_steps(2, 2)
        })
        .join()
        .unwrap(),
    );
    assert!(seen == expected);
}

#[test]
fn a_reset_instance_repeats_its_first_run_bit_by_bit() {
    for level in [1, 3] {
        let host = Host::new();
        let run = || {
            host.set_integer("scene.gear_contact", level);
            host.set_many(&["inertia.left_end", "inertia.right_end"], &[0.5, 0.5]);
            host.start();
            host.record_steps(0, 5)
        };
        let first = run();
        assert_eq!(host.reset(), Status::Ok);
        assert!(run() == first, "level {level}");
        assert_eq!(host.terminate(), Status::Ok);
        assert_eq!(host.reset(), Status::Ok);
        assert!(run() == first, "level {level}");
    }
}

#[test]
fn versions_are_those_of_fmi_2() {
    // SAFETY: both return static strings
    let texts = unsafe { [fmi2GetVersion(), fmi2GetTypesPlatform()].map(|t| std::ffi::CStr::from_ptr(t)) };
    assert_eq!(texts, [c"2.0", c"default"]);
}

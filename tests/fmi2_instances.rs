//! Instances: how they come to be, how many there may be, on which threads, and what they say.

mod common;

use std::ptr;
use std::sync::Mutex;
use std::sync::atomic::{AtomicI32, AtomicPtr, Ordering};

use bevel_differential::fmi2::*;
use bevel_differential::variables;
use common::{Host, assert_tells, callbacks};
use libc::c_void;

#[test]
fn a_wrong_guid_is_refused_with_both_guids_in_the_log() {
    let wrong = "{8c4e810f-3df3-4a00-8276-176fa3c9f000}";
    let host = Host::instantiate(Some("test"), CO_SIMULATION, Some(wrong), None);
    assert!(host.c.is_null());
    assert_tells(&host.last(), &["fmi2Instantiate", wrong, variables::guid()]);
    let host = Host::instantiate(Some("test"), CO_SIMULATION, None, None);
    assert!(host.c.is_null());
    assert_tells(&host.last(), &["NULL", variables::guid()]);
}

#[test]
fn a_missing_name_and_an_unknown_kind_are_refused() {
    for name in [None, Some("")] {
        let host = Host::instantiate(name, CO_SIMULATION, Some(variables::guid()), None);
        assert!(host.c.is_null());
        assert_tells(&host.last(), &["name"]);
    }
    for kind in [2, -1, 7] {
        let host = Host::instantiate(Some("test"), kind, Some(variables::guid()), None);
        assert!(host.c.is_null());
        assert_tells(&host.last(), &["co-simulation"]);
    }
}

#[test]
fn any_resource_location_will_do() {
    let locations =
        ["", "file:///p%20q/resources", "file:/p", "file://localhost/p", "C:\\p", "https://example.org", "\u{fc}"];
    for location in [None].into_iter().chain(locations.map(Some)) {
        let host = Host::instantiate(Some("test"), CO_SIMULATION, Some(variables::guid()), location);
        assert!(!host.c.is_null(), "{location:?}");
        assert_eq!(host.enter(), Status::Ok);
    }
}

#[test]
fn without_callbacks_or_logger_everything_works_in_silence() {
    let lines = Mutex::new(Vec::new());
    let silent = CallbackFunctions { logger: None, ..callbacks(&lines) };
    let guid = std::ffi::CString::new(variables::guid()).unwrap();
    for callbacks in [ptr::null(), &raw const silent] {
        // SAFETY: all arguments are valid through the calls
        unsafe {
            assert!(fmi2Instantiate(c"test".as_ptr(), 1, ptr::null(), ptr::null(), callbacks, 0, 1).is_null());
            let c = fmi2Instantiate(c"test".as_ptr(), 1, guid.as_ptr(), ptr::null(), callbacks, 0, 1);
            assert!(!c.is_null());
            assert_eq!(fmi2DoStep(c, 0.0, 1.0, 0), Status::Error);
            assert_eq!(fmi2EnterInitializationMode(c), Status::Ok);
            assert_eq!(fmi2ExitInitializationMode(c), Status::Ok);
            assert_eq!(fmi2DoStep(c, 0.0, 1e-3, 0), Status::Ok);
            fmi2FreeInstance(c);
        }
    }
}

#[test]
fn percent_signs_never_reach_the_printf_of_the_host() {
    // the test's logger refuses any percent sign
    let host = Host::instantiate(Some("100%s"), CO_SIMULATION, Some("%n%s%d"), None);
    assert!(host.c.is_null());
    assert_tells(&host.last(), &["percent"]);
}

#[test]
fn categories_choose_what_is_sent() {
    let send = |logging, categories: &[Text]| {
        let host = Host::new();
        // SAFETY: a live component and an array of strings
        let status = unsafe { fmi2SetDebugLogging(host.c, logging, categories.len(), categories.as_ptr()) };
        host.start();
        assert_eq!(host.set("left.load_torque", f64::NAN), Status::Discard);
        assert_eq!(host.enter(), Status::Error);
        let log = host.log();
        let sent = |category: Category| log.iter().any(|l| l.category == category.name().to_str().unwrap());
        (status, sent(Category::Error), sent(Category::Discard), sent(Category::Events))
    };
    let (error, discard, events) = (c"logStatusError", c"logStatusDiscard", c"logEvents");
    assert_eq!(send(1, &[]), (Status::Ok, true, true, true));
    assert_eq!(send(0, &[]), (Status::Ok, true, true, false));
    assert_eq!(send(1, &[error.as_ptr()]), (Status::Ok, true, false, false));
    assert_eq!(send(1, &[discard.as_ptr(), events.as_ptr()]), (Status::Ok, false, true, true));
    // unknown names are told, the known ones count
    assert_eq!(send(1, &[error.as_ptr(), c"logNonsense".as_ptr(), ptr::null()]), (Status::Warning, true, false, false));
}

#[test]
fn a_logger_that_calls_back_is_refused_and_does_no_harm() {
    static COMPONENT: AtomicPtr<c_void> = AtomicPtr::new(ptr::null_mut());
    static ANSWER: AtomicI32 = AtomicI32::new(-1);
    unsafe extern "C" fn logger(_: *mut c_void, _: Text, _: Status, _: Text, _: Text) {
        // SAFETY: the component lives; the call is what is tested
        let status = unsafe { fmi2Reset(COMPONENT.load(Ordering::Relaxed)) };
        ANSWER.store(status as i32, Ordering::Relaxed);
    }
    let lines = Mutex::new(Vec::new());
    // SAFETY: as in `common::callbacks`
    let logger =
        unsafe { std::mem::transmute::<unsafe extern "C" fn(*mut c_void, Text, Status, Text, Text), Logger>(logger) };
    let callbacks = CallbackFunctions { logger: Some(logger), ..callbacks(&lines) };
    let guid = std::ffi::CString::new(variables::guid()).unwrap();
    // SAFETY: all arguments are valid through the calls
    unsafe {
        let c = fmi2Instantiate(c"test".as_ptr(), 1, guid.as_ptr(), ptr::null(), &callbacks, 0, 0);
        COMPONENT.store(c, Ordering::Relaxed);
        assert_eq!(fmi2DoStep(c, 0.0, 1.0, 0), Status::Error);
        assert_eq!(ANSWER.load(Ordering::Relaxed), Status::Error as i32);
        assert_eq!(fmi2EnterInitializationMode(c), Status::Ok);
        fmi2FreeInstance(c);
    }
}

#[test]
fn a_thousand_instances_live_side_by_side() {
    let plain = Host::on_level(3);
    plain.start();
    let expected = plain.journey(0, 1);
    let hosts: Vec<_> = (0..1000).map(|_| Host::on_level(3)).collect();
    hosts.iter().for_each(Host::start);
    for host in &hosts {
        assert!(host.journey(0, 1) == expected);
    }
}

#[test]
fn eight_threads_with_small_stacks_give_the_same_results() {
    for level in [1, 3] {
        let journey = move || {
            let host = Host::on_level(level);
            host.start();
            let state = host.get_state();
            let bytes = host.serialize(state);
            let (status, copy) = host.deserialize(&bytes);
            assert_eq!(status, Status::Ok);
            assert_eq!(host.set("left.load_torque", f64::NAN), Status::Discard);
            host.free_state(state);
            host.free_state(copy);
            host.journey(0, 20)
        };
        let expected = journey();
        let spawn = |_| std::thread::Builder::new().stack_size(128 * 1024).spawn(journey).unwrap();
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
    let expected = plain.journey(0, 4);
    let host = Host::on_level(3);
    host.start();
    let mut seen = host.journey(0, 2);
    struct Moved(Host);
    // SAFETY: one thread at a time, as the join below sees to
    unsafe impl Send for Moved {}
    let moved = Moved(host);
    seen.extend(
        std::thread::spawn(move || {
            let whole = moved;
            whole.0.journey(2, 2)
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
            host.journey(0, 5)
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

//! Tests of log messages and of the settings that select them.

use std::ptr;
use std::sync::atomic::{AtomicI32, AtomicPtr, Ordering};

use bevel_differential::fmi2::*;
use bevel_differential::variables;
use libc::c_void;

use crate::common::recorder::{Recorder, callbacks};
use crate::common::{Host, assert_contains};

#[test]
fn without_callbacks_or_logger_everything_works() {
    let silent = CallbackFunctions { logger: None, ..Recorder::default().callbacks() };
    let guid = std::ffi::CString::new(variables::guid()).unwrap();
    for callbacks in [ptr::null(), &raw const silent] {
        // SAFETY: all arguments are valid during the calls
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
    // the recorder rejects any percent sign
    let host = Host::instantiate(Some("100%s"), CO_SIMULATION, Some("%n%s%d"), None);
    assert!(host.c.is_null());
    assert_contains(&host.last_message(), &["percent"]);
}

/// Categories of the lines logged by a run: its start, a discarded call and a refused call.
fn logged_by_a_run(host: &Host) -> Vec<String> {
    // drag without any torque causes a warning
    assert_eq!(host.set_boolean("effects.bearing_drag", 1), Status::Ok);
    host.start();
    assert_eq!(host.set("left.load_torque", f64::NAN), Status::Discard);
    assert_eq!(host.enter(), Status::Error);
    host.log().into_iter().map(|line| line.category).collect()
}

const ERROR: &str = "logStatusError";
const WARNING: &str = "logStatusWarning";
const DISCARD: &str = "logStatusDiscard";
const EVENTS: &str = "logEvents";

#[test]
fn with_logging_off_only_calls_that_fail_are_logged() {
    // the last event lists values that were not set
    assert_eq!(logged_by_a_run(&Host::with_logging(1)), [EVENTS, WARNING, EVENTS, DISCARD, ERROR]);
    assert_eq!(logged_by_a_run(&Host::with_logging(0)), [DISCARD, ERROR]);
}

#[test]
fn categories_select_messages_but_errors_are_always_logged() {
    let run = |logging, categories: &[Text]| {
        let host = Host::with_logging(0);
        // SAFETY: a live component and an array of strings
        let status = unsafe { fmi2SetDebugLogging(host.c, logging, categories.len(), categories.as_ptr()) };
        let at_once = host.log().len();
        (status, logged_by_a_run(&host).split_off(at_once))
    };
    let selected = |categories: &[&str]| (Status::Ok, categories.iter().map(|&c| c.to_owned()).collect::<Vec<_>>());
    let (error, warning) = (c"logStatusError".as_ptr(), c"logStatusWarning".as_ptr());
    let (discard, events) = (c"logStatusDiscard".as_ptr(), c"logEvents".as_ptr());
    assert_eq!(run(1, &[]), selected(&[EVENTS, WARNING, EVENTS, DISCARD, ERROR]));
    assert_eq!(run(1, &[error]), selected(&[ERROR]));
    assert_eq!(run(1, &[warning]), selected(&[WARNING, ERROR]));
    assert_eq!(run(1, &[discard, events]), selected(&[EVENTS, EVENTS, DISCARD, ERROR]));
    assert_eq!(run(0, &[]), selected(&[DISCARD, ERROR]));
    assert_eq!(run(0, &[warning, events]), selected(&[DISCARD, ERROR]), "with logging off, categories have no effect");
    // unknown names are reported, and known ones are used
    assert_eq!(run(1, &[error, c"logNonsense".as_ptr(), ptr::null()]), (Status::Warning, vec![ERROR.to_owned()]));
}

#[test]
fn stresses_above_the_strength_are_reported_once_with_logging_on_and_never_with_logging_off() {
    for (on, expected) in [(1, 3), (0, 0)] {
        let host = Host::with_logging(on);
        assert_eq!(host.set_boolean("effects.strength", 1), Status::Ok);
        assert_eq!(host.set("strength.bending_strength", 1e7), Status::Ok);
        assert_eq!(host.set("strength.contact_strength", 1e8), Status::Ok);
        host.start();
        host.steps(0.0, 1e-3, 20);
        let lines = host.log().into_iter().filter(|line| line.message.contains("exceeds the strength")).count();
        assert_eq!(lines, expected, "{:?}", host.log());
    }
}

#[test]
fn a_call_from_within_the_logger_is_refused_and_harmless() {
    static COMPONENT: AtomicPtr<c_void> = AtomicPtr::new(ptr::null_mut());
    static RESULT: AtomicI32 = AtomicI32::new(-1);
    unsafe extern "C" fn logger(_: *mut c_void, _: Text, _: Status, _: Text, _: Text) {
        // SAFETY: a live component; the call is the object of the test
        let status = unsafe { fmi2Reset(COMPONENT.load(Ordering::Relaxed)) };
        RESULT.store(status as i32, Ordering::Relaxed);
    }
    let callbacks = callbacks(logger, ptr::null_mut());
    let guid = std::ffi::CString::new(variables::guid()).unwrap();
    // SAFETY: all arguments are valid during the calls
    unsafe {
        let c = fmi2Instantiate(c"test".as_ptr(), 1, guid.as_ptr(), ptr::null(), &callbacks, 0, 0);
        COMPONENT.store(c, Ordering::Relaxed);
        assert_eq!(fmi2DoStep(c, 0.0, 1.0, 0), Status::Error);
        assert_eq!(RESULT.load(Ordering::Relaxed), Status::Error as i32);
        assert_eq!(fmi2EnterInitializationMode(c), Status::Ok);
        fmi2FreeInstance(c);
    }
}

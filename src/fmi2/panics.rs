//! Tests: no panic leaves a call. No host can provoke one, so these tests enter calls as the exports do, and check in the
//! source of the exports that all of them are entered this way.

use std::cell::RefCell;
use std::ffi::{CStr, CString};
use std::ptr;

use libc::c_void;

use super::calls::{Call, Phase};
use super::component::{Component, run};
use super::exports::{fmi2FreeInstance, fmi2GetReal, fmi2Reset};
use super::instance::Instance;
use super::log::Log;
use super::types::{CallbackFunctions, Kind, Logger, Status, Text};

type Lines = RefCell<Vec<(Status, String)>>;

unsafe extern "C" fn logger(env: *mut c_void, _: Text, status: Status, _: Text, message: Text) {
    // SAFETY: `env` is the lines of the test that runs; the text comes from the library
    let (lines, text) = unsafe { (&*env.cast::<Lines>(), CStr::from_ptr(message)) };
    lines.borrow_mut().push((status, text.to_string_lossy().into_owned()));
}

/// A component in `phase` that logs into `lines`.
fn component(kind: Kind, phase: Phase, lines: &Lines) -> *mut c_void {
    // SAFETY: on the platforms the tests run on, fixed arguments reach a plain function as they reach a variadic one
    let logger =
        unsafe { std::mem::transmute::<unsafe extern "C" fn(*mut c_void, Text, Status, Text, Text), Logger>(logger) };
    let callbacks = CallbackFunctions {
        logger: Some(logger),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: ptr::from_ref(lines).cast_mut().cast(),
    };
    let mut instance = Instance::new(kind, Log::new(Some(callbacks), CString::default(), false));
    instance.now.phase = phase;
    Component::into_pointer(instance)
}

#[test]
fn a_panic_in_any_call_is_an_error_with_a_message_and_reset_recovers() {
    for kind in [Kind::CoSimulation, Kind::ModelExchange] {
        for &call in Call::ALL {
            let Some(phase) = Phase::ALL.into_iter().find(|&phase| call.legal(phase)) else { continue };
            let lines = Lines::default();
            let c = component(kind, phase, &lines);
            // SAFETY: a live component
            let statuses = unsafe {
                [run(c, call, |_, _| panic!("provoked")), fmi2GetReal(c, &0, 1, &mut 0.0), fmi2Reset(c), fmi2Reset(c)]
            };
            assert_eq!(statuses, [Status::Error, Status::Ok, Status::Ok, Status::Ok], "{}", call.name());
            let logged = lines.take();
            assert_eq!((logged.len(), logged[0].0), (1, Status::Error), "{logged:?}");
            for words in [call.name(), "internal error", "provoked", "fmi2Reset"] {
                assert!(logged[0].1.contains(words), "{words:?} is missing in {logged:?}");
            }
            // SAFETY: a live component, the last use of it
            unsafe { fmi2FreeInstance(c) };
        }
    }
}

#[test]
fn a_panic_without_a_text_is_an_error_too() {
    let lines = Lines::default();
    let c = component(Kind::CoSimulation, Phase::Instantiated, &lines);
    // SAFETY: a live component
    let status = unsafe { run(c, Call::GetReal, |_, _| std::panic::panic_any(7)) };
    assert_eq!(status, Status::Error);
    assert!(lines.borrow()[0].1.contains("no message"));
    // SAFETY: a live component, the last use of it
    unsafe { fmi2FreeInstance(c) };
}

/// Entries that catch panics. Two functions return a constant and cannot panic.
const ENTRIES: [&str; 5] = ["{ run(c, Call::", "panic_guard::catch(", "component::free(c)", "c\"default\"", "c\"2.0\""];

#[test]
fn every_export_catches_panics() {
    let files = [
        include_str!("exports/derivatives.rs"),
        include_str!("exports/exchange.rs"),
        include_str!("exports/lifecycle.rs"),
        include_str!("exports/states.rs"),
        include_str!("exports/stepping.rs"),
        include_str!("exports/variables.rs"),
    ];
    let listed = include_str!("exports/mod.rs").lines().filter(|line| line.starts_with("mod ")).count();
    assert_eq!(files.len(), listed, "a file of exports is not checked");
    let mut seen = 0;
    for export in files.iter().flat_map(|file| file.split("#[unsafe(no_mangle)]").skip(1)) {
        let signature = export.lines().nth(1).unwrap_or_default();
        assert!(export.trim_start().starts_with("pub ") && export.contains("extern \"C\" fn"), "{signature}");
        assert_eq!(ENTRIES.iter().filter(|entry| export.contains(**entry)).count(), 1, "{signature}");
        seen += 1;
    }
    let unmangled: usize = files.iter().map(|file| file.matches("no_mangle").count()).sum();
    assert_eq!(seen, unmangled);
}

//! Tests that no panic leaves a call. A host cannot provoke a panic. These tests therefore enter the calls by the same
//! function as the exports. They check in the source text that all exports use this function.

use std::ffi::CString;

use super::exports::{fmi2FreeInstance, fmi2GetReal, fmi2Reset};
use super::logger::HostLogger;
use super::types::{ComponentPointer, Kind, Status};
use super::{Call, INTERFACE, Phase};
use crate::instance::{Component, Instance, LegalCall, Log, run};

#[path = "../../../tests/common/recorder.rs"]
mod recorder;

use recorder::Recorder;

/// Creates a component in `phase` that logs to `recorder`.
fn component(kind: Kind, phase: Phase, recorder: &Recorder) -> ComponentPointer {
    let log = Log::new(HostLogger::of(Some(recorder.callbacks()), CString::default()), false);
    let mut instance = Instance::new(&INTERFACE, kind, log);
    instance.now.phase = phase;
    Component::into_pointer(instance)
}

#[test]
fn a_panic_in_any_call_is_an_error_with_a_message_and_reset_recovers() {
    for kind in [Kind::CoSimulation, Kind::ModelExchange] {
        for &call in Call::ALL {
            let Some(phase) = Phase::ALL.into_iter().find(|&phase| call.legal(phase)) else { continue };
            let recorder = Recorder::default();
            let c = component(kind, phase, &recorder);
            // SAFETY: a live component
            let statuses = unsafe {
                [run(c, call, |_, _| panic!("provoked")), fmi2GetReal(c, &0, 1, &mut 0.0), fmi2Reset(c), fmi2Reset(c)]
            };
            assert_eq!(statuses, [Status::Error, Status::Ok, Status::Ok, Status::Ok], "{}", call.name());
            let logged = recorder.lines();
            assert_eq!((logged.len(), logged[0].status), (1, Status::Error), "{logged:?}");
            for words in [call.name(), "internal error", "provoked", "fmi2Reset"] {
                assert!(logged[0].message.contains(words), "{words:?} is missing in {logged:?}");
            }
            // SAFETY: a live component, used for the last time
            unsafe { fmi2FreeInstance(c) };
        }
    }
}

#[test]
fn a_panic_without_a_message_is_also_an_error() {
    let recorder = Recorder::default();
    let c = component(Kind::CoSimulation, Phase::Instantiated, &recorder);
    // SAFETY: a live component
    let status = unsafe { run(c, Call::GetReal, |_, _| std::panic::panic_any(7)) };
    assert_eq!(status, Status::Error);
    assert!(recorder.lines()[0].message.contains("no message"));
    // SAFETY: a live component, used for the last time
    unsafe { fmi2FreeInstance(c) };
}

/// Allowed entries of an export: three that catch panics, and two constants that cannot panic.
const ENTRIES: [&str; 5] = ["call!(c, ", " catch(", "{ free(c) }", "c\"default\"", "c\"2.0\""];

#[test]
fn every_export_catches_panics() {
    let files = [
        include_str!("../exports/derivatives.rs"),
        include_str!("../exports/exchange.rs"),
        include_str!("../exports/lifecycle.rs"),
        include_str!("../exports/states.rs"),
        include_str!("../exports/stepping.rs"),
        include_str!("../exports/variables.rs"),
    ];
    let listed = include_str!("../exports/mod.rs").lines().filter(|line| line.starts_with("mod ")).count();
    assert_eq!(files.len(), listed, "a file of exports is not checked");
    // and the macros that both versions of FMI share
    let shared = include_str!("../../instance/exports.rs");
    let files = [files.as_slice(), &[shared]].concat();
    let mut seen = 0;
    for export in files.iter().flat_map(|file| file.split("#[unsafe(no_mangle)]").skip(1)) {
        let signature = export.lines().nth(1).unwrap_or_default();
        assert!(export.trim_start().starts_with("pub ") && export.contains("extern \"C\" fn"), "{signature}");
        assert_eq!(ENTRIES.iter().filter(|entry| export.contains(**entry)).count(), 1, "{signature}");
        seen += 1;
    }
    let unmangled: usize = files.iter().map(|file| file.matches("no_mangle").count()).sum();
    assert_eq!(seen, unmangled);
    assert!(shared.contains("{ $crate::instance::run($c, Call::$call, body) }"), "call! goes through `run`");
}

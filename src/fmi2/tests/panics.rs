//! Tests that no panic leaves a call. A host cannot provoke a panic. These tests therefore enter the calls by the same
//! function as the exports. They check in the source text that all exports use this function.

use std::ffi::CString;
use std::fs;
use std::path::Path;

use super::logger::HostLogger;
use super::types::{ComponentPointer, Kind, Status};
use super::{CALLS, INTERFACE, Phase, fmi2FreeInstance, fmi2GetReal, fmi2Reset};
use crate::instance::{Component, Instance, Log, run};

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
        for call in CALLS {
            let Some(phase) = Phase::ALL.into_iter().find(|&phase| call.is_legal(phase)) else { continue };
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
    let status = unsafe { run(c, &CALLS[0], |_, _| std::panic::panic_any(7)) };
    assert_eq!(status, Status::Error);
    assert!(recorder.lines()[0].message.contains("no message"));
    // SAFETY: a live component, used for the last time
    unsafe { fmi2FreeInstance(c) };
}

/// Allowed entries of an export: five that catch panics, and constants that cannot panic.
const ENTRIES: [&str; 8] = [
    "{ $crate::instance::run(c, &$call, body) }",
    " create(|",
    "{ instantiate(",
    "{ free(c) }",
    "{ part(c, ",
    "c\"default\"",
    "c\"2.0\"",
    "c\"3.0\"",
];

#[test]
fn every_export_catches_panics() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut exports = Vec::new();
    for file in ["instance/component.rs", "fmi2/special.rs", "fmi3/special.rs"] {
        let text = fs::read_to_string(source.join(file)).unwrap();
        exports.extend(text.split("#[unsafe(no_mangle)]").skip(1).map(str::to_owned));
    }
    for export in &exports {
        let signature = export.lines().nth(1).unwrap_or_default();
        assert!(export.trim_start().starts_with("pub ") && export.contains("extern \"C\" fn"), "{signature}");
        assert_eq!(ENTRIES.iter().filter(|entry| export.contains(**entry)).count(), 1, "{signature}");
    }
    assert_eq!(exports.len(), mentions(&source), "no other file exports functions");
}

/// Number of functions with C names in the files of a folder, without this file.
fn mentions(folder: &Path) -> usize {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let own = |path: &Path| path.ends_with("fmi2/tests/panics.rs");
    entries
        .filter(|path| !own(path))
        .map(|path| {
            if path.is_dir() { mentions(&path) } else { fs::read_to_string(path).unwrap().matches("no_mangle").count() }
        })
        .sum()
}

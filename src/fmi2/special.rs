//! The C functions that are not called on an instance: versions, and the creation and the end of instances.

#![allow(clippy::missing_safety_doc)] // the rules of `calls` apply to all
#![allow(non_snake_case)] // FMI's names

use std::ffi::{CStr, CString};
use std::ptr;

use super::logger::HostLogger;
use super::types::*;
use crate::FULL;
use crate::instance::c_types::c_int;
use crate::instance::{Instance, Interface, Log, create, free};
use crate::variables::{MODEL_NAME, guid};

/// FMI 2.0.
pub static INTERFACE: Interface = Interface {
    version: 2,
    setup: "fmi2SetupExperiment",
    set_state: "fmi2SetFMUstate",
    reset: "fmi2Reset",
    exit_initialization: "fmi2ExitInitializationMode",
};

/// fmi2GetTypesPlatform.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> Text {
    c"default".as_ptr()
}

/// fmi2GetVersion.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> Text {
    c"2.0".as_ptr()
}

/// fmi2Instantiate. The resource location is not used, so any value is accepted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: Text,
    kind: c_int,
    guid: Text,
    _resources: Text,
    callbacks: *const CallbackFunctions,
    _visible: Boolean,
    logging: Boolean,
) -> ComponentPointer {
    // without a valid pointer to the logger, the error cannot be reported
    if !callbacks.is_aligned() {
        return ptr::null_mut();
    }
    create(|host| {
        // SAFETY: the host's promise, see `calls`
        let (name, guid) = unsafe { (host.string(name), host.string(guid)) };
        // SAFETY: as above; aligned, and `as_ref` returns None for NULL
        let callbacks = unsafe { callbacks.as_ref() }.copied();
        instantiate(name, kind, guid, callbacks, logging != 0)
    })
}

/// Creates an instance. Logs an error and returns `None` if the arguments are for another FMU or of an unknown kind.
fn instantiate(
    name: Option<&CStr>,
    kind: c_int,
    given: Option<&CStr>,
    callbacks: Option<CallbackFunctions>,
    logging_on: bool,
) -> Option<Instance> {
    let named = name.filter(|n| !n.is_empty());
    let label = named.map_or_else(|| CString::new(MODEL_NAME).unwrap_or_default(), CStr::to_owned);
    let log = Log::new(HostLogger::of(callbacks, label), logging_on);
    let requested = match kind {
        CO_SIMULATION => Some(Kind::CoSimulation),
        MODEL_EXCHANGE => Some(Kind::ModelExchange),
        _ => None,
    };
    let problem = if named.is_none() {
        "the instance name is NULL or empty".to_owned()
    } else if given.is_none_or(|g| g.to_bytes() != guid().as_bytes()) {
        let given = given.map_or("NULL".into(), |g| format!("\"{}\"", g.to_string_lossy()));
        format!("the GUID {given} of the model description is not this binary's GUID \"{}\"", guid())
    } else if let (false, Some(Kind::ModelExchange)) = (FULL, requested) {
        "this build for real-time targets supports co-simulation only".to_owned()
    } else if let Some(kind) = requested {
        return Some(Instance::new(&INTERFACE, kind, log));
    } else {
        format!("type {kind} is neither model exchange ({MODEL_EXCHANGE}) nor co-simulation ({CO_SIMULATION})")
    };
    log.status(Status::Error, &format!("fmi2Instantiate: {problem}"));
    None
}

/// fmi2FreeInstance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: ComponentPointer) {
    // SAFETY: the host's promise, see `calls`
    unsafe { free(c) }
}

//! Version, instances, logging, and the calls from instantiation to termination.

use std::ffi::CStr;
use std::ptr;

use super::super::logger::HostLogger;
use super::*;
use crate::instance::{Allowed, Component, Experiment, Log, Sink, catch, free};
use crate::variables::guid;

/// fmi3GetVersion.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> Text {
    c"3.0".as_ptr()
}

/// fmi3InstantiateModelExchange. The resource path is not used, so any value is accepted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    name: Text,
    token: Text,
    _resources: Text,
    _visible: Boolean,
    logging: Boolean,
    environment: *mut c_void,
    message: Option<LogMessage>,
) -> ComponentPointer {
    let allowed = Allowed { events: true, ..Allowed::default() };
    // SAFETY: the host's promise, see the module
    let instance =
        catch(|| unsafe { instantiate(Kind::ModelExchange, [name, token], logging, environment, message, allowed) });
    instance.ok().flatten().map_or(ptr::null_mut(), Component::into_pointer)
}

/// fmi3InstantiateCoSimulation. All variables may be read in intermediate update mode, not only those that the host
/// names.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: Text,
    token: Text,
    _resources: Text,
    _visible: Boolean,
    logging: Boolean,
    event_mode_used: Boolean,
    early_return_allowed: Boolean,
    _intermediate: *const ValueReference,
    _intermediate_count: usize,
    environment: *mut c_void,
    message: Option<LogMessage>,
    update: Option<IntermediateUpdate>,
) -> ComponentPointer {
    let allowed = Allowed {
        events: event_mode_used != 0,
        early_return: early_return_allowed != 0,
        update: [update.map_or(0, |update| update as usize), environment as usize],
    };
    // SAFETY: the host's promise, see the module
    let instance =
        catch(|| unsafe { instantiate(Kind::CoSimulation, [name, token], logging, environment, message, allowed) });
    instance.ok().flatten().map_or(ptr::null_mut(), Component::into_pointer)
}

/// fmi3InstantiateScheduledExecution. The FMU has no model partitions, so the call always fails.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    _name: Text,
    _token: Text,
    _resources: Text,
    _visible: Boolean,
    _logging: Boolean,
    environment: *mut c_void,
    message: Option<LogMessage>,
    _clock_update: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> ComponentPointer {
    let refused = "fmi3InstantiateScheduledExecution: this FMU is for co-simulation and model exchange";
    let _ = catch(|| log(environment, message, false).status(Status::Error, refused));
    ptr::null_mut()
}

fn log(environment: *mut c_void, message: Option<LogMessage>, logging: bool) -> Log {
    let sink = message.map(|message| Box::new(HostLogger { message, environment }) as Box<dyn Sink>);
    Log::new(sink, logging)
}

/// Creates an instance. Logs an error and returns `None` if the arguments are for another FMU.
///
/// # Safety
/// Both texts are NULL or end with NUL.
unsafe fn instantiate(
    kind: Kind,
    texts: [Text; 2],
    logging: Boolean,
    environment: *mut c_void,
    message: Option<LogMessage>,
    allowed: Allowed,
) -> Option<Instance> {
    let log = log(environment, message, logging != 0);
    let problem = HostMemory::during_call(|host| {
        // SAFETY: the caller's promise
        let [name, token] = texts.map(|text| unsafe { host.string(text) });
        if name.is_none_or(CStr::is_empty) {
            return Some("the instance name is NULL or empty".to_owned());
        }
        if token.is_some_and(|token| token.to_bytes() == guid().as_bytes()) {
            return None;
        }
        let given = token.map_or("NULL".into(), |token| format!("\"{}\"", token.to_string_lossy()));
        Some(format!("the instantiation token {given} is not this binary's token \"{}\"", guid()))
    });
    if let Some(problem) = problem {
        log.status(Status::Error, &format!("fmi3Instantiate: {problem}"));
        return None;
    }
    let mut instance = Instance::new(&INTERFACE, kind, log);
    instance.allowed = allowed;
    Some(instance)
}

/// fmi3FreeInstance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(c: ComponentPointer) {
    // SAFETY: the host's promise, see the module
    unsafe { free(c) }
}

debug_logging!(fmi3SetDebugLogging);

/// fmi3EnterInitializationMode.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    c: ComponentPointer,
    tolerance_defined: Boolean,
    tolerance: f64,
    start: f64,
    stop_defined: Boolean,
    stop: f64,
) -> Status {
    let experiment = Experiment {
        tolerance: (tolerance_defined != 0).then_some(tolerance),
        start,
        stop: (stop_defined != 0).then_some(stop),
    };
    call!(c, EnterInitializationMode, |instance, _| {
        instance.setup_experiment(&experiment)?;
        instance.enter_initialization()
    })
}

plain! {
    fmi3ExitInitializationMode ExitInitializationMode exit_initialization;
    fmi3EnterConfigurationMode EnterConfigurationMode enter_configuration;
    fmi3ExitConfigurationMode ExitConfigurationMode exit_configuration;
    fmi3Terminate Terminate terminate;
    fmi3Reset Reset reset;
}

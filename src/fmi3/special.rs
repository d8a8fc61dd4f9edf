//! The C functions that are not one call on an instance: the version, the creation and the end of instances, and steps
//! within which the host is called back.

#![allow(clippy::missing_safety_doc)] // the rules of `calls` apply to all
#![allow(non_snake_case)] // FMI's names

use std::ffi::CStr;

use super::calls::{CONTINUE_STEP, DO_STEP};
use super::logger::HostLogger;
use super::types::*;
use crate::instance::c_types::c_void;
use crate::instance::{Allowed, Ended, HostMemory, Instance, Interface, Log, Phase, Sink, create, free, run};
use crate::variables::guid;

/// FMI 3.0.
pub static INTERFACE: Interface = Interface {
    version: 3,
    setup: "fmi3EnterInitializationMode",
    set_state: "fmi3SetFMUState",
    reset: "fmi3Reset",
    exit_initialization: "fmi3ExitInitializationMode",
};

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
    // SAFETY: the host's promise, see `calls`
    unsafe { instantiate(Kind::ModelExchange, [name, token], logging, environment, message, allowed) }
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
    // SAFETY: the host's promise, see `calls`
    unsafe { instantiate(Kind::CoSimulation, [name, token], logging, environment, message, allowed) }
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
    create(|_| {
        log(environment, message, false).status(Status::Error, refused);
        None
    })
}

fn log(environment: *mut c_void, message: Option<LogMessage>, logging: bool) -> Log {
    let sink = message.map(|message| Box::new(HostLogger { message, environment }) as Box<dyn Sink>);
    Log::new(sink, logging)
}

/// Creates an instance. Logs an error and returns NULL if the arguments are for another FMU.
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
) -> ComponentPointer {
    create(|host| {
        let log = log(environment, message, logging != 0);
        // SAFETY: the caller's promise
        let [name, token] = texts.map(|text| unsafe { host.string(text) });
        let problem = if name.is_none_or(CStr::is_empty) {
            "the instance name is NULL or empty".to_owned()
        } else if token.is_some_and(|token| token.to_bytes() == guid().as_bytes()) {
            let mut instance = Instance::new(&INTERFACE, kind, log);
            instance.allowed = allowed;
            return Some(instance);
        } else {
            let given = token.map_or("NULL".into(), |token| format!("\"{}\"", token.to_string_lossy()));
            format!("the instantiation token {given} is not this binary's token \"{}\"", guid())
        };
        log.status(Status::Error, &format!("fmi3Instantiate: {problem}"));
        None
    })
}

/// fmi3FreeInstance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(c: ComponentPointer) {
    // SAFETY: the host's promise, see `calls`
    unsafe { free(c) }
}

/// fmi3DoStep. The flag `_never_back` is ignored, because snapshots are complete even if the host goes back in time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    c: ComponentPointer,
    point: f64,
    size: f64,
    _never_back: Boolean,
    event_needed: *mut Boolean,
    terminate: *mut Boolean,
    early_return: *mut Boolean,
    last_time: *mut f64,
) -> Status {
    // the end of the step stays the host's value, to avoid rounding over several parts
    let (mut begin, mut size, until) = (point, size, point + size);
    loop {
        // SAFETY: the host's promise, see `calls`
        let (status, part) =
            unsafe { part(c, [begin, size, until], [event_needed, terminate, early_return], last_time) };
        let Some(Part { ended, update, environment, may_return }) = part else { return status };
        let is_last = ended.is_done;
        let may_return = may_return && !is_last;
        let (mut wants_return, mut return_time) = (0, ended.time);
        // SAFETY: the host keeps its function valid; the instance accepts calls while the function runs
        unsafe {
            update(
                environment,
                ended.time,
                Boolean::from(!is_last),
                1,
                Boolean::from(!is_last),
                Boolean::from(may_return),
                &mut wants_return,
                &mut return_time,
            );
        }
        let returns = wants_return != 0 && may_return;
        // SAFETY: the host's promise, see `calls`
        let status = unsafe { end_update(c, returns, early_return) };
        if status != Status::Ok || is_last || returns {
            return status;
        }
        (begin, size) = (ended.time, until - ended.time);
    }
}

/// A part of a step, after which the host is called back.
struct Part {
    ended: Ended,
    update: IntermediateUpdate,
    environment: *mut c_void,
    may_return: bool,
}

/// Advances by a part of a step and writes the outputs as if the step ended here. Without a callback function, the part
/// is the whole step.
unsafe fn part(
    c: ComponentPointer,
    [point, size, until]: [f64; 3],
    flags: [*mut Boolean; 3],
    last_time: *mut f64,
) -> (Status, Option<Part>) {
    let mut part = None;
    let body = |instance: &mut Instance, host: &HostMemory| {
        // SAFETY: the host's promise, see `calls`
        let [event, terminate, early] = unsafe {
            [
                host.output_value("eventHandlingNeeded", flags[0])?,
                host.output_value("terminateSimulation", flags[1])?,
                host.output_value("earlyReturn", flags[2])?,
            ]
        };
        // SAFETY: as above
        let last = unsafe { host.output_value("lastSuccessfulTime", last_time)? };
        terminate.write(0);
        event.write(0);
        early.write(0);
        last.write(instance.now.simulation.as_ref().map_or(point, |simulation| simulation.time()));
        let [update, environment] = instance.allowed.update;
        let ended = instance.step_to_event([point, size, until], update != 0).inspect_err(|_| {
            // a discarded step has advanced to where it failed
            last.write(instance.now.simulation.as_ref().map_or(point, |simulation| simulation.time()));
        })?;
        event.write(Boolean::from(ended.event));
        early.write(Boolean::from(ended.early));
        last.write(ended.time);
        if update != 0 {
            instance.now.phase = Phase::IntermediateUpdate;
            // SAFETY: the address of the host's function, from fmi3InstantiateCoSimulation
            let update = unsafe { std::mem::transmute::<usize, IntermediateUpdate>(update) };
            let may_return = instance.allowed.early_return;
            part = Some(Part { ended, update, environment: environment as *mut c_void, may_return });
        }
        Ok(())
    };
    // SAFETY: as above
    let status = unsafe { run(c, &DO_STEP, body) };
    (status, part)
}

/// Ends the host's intermediate update within a step.
unsafe fn end_update(c: ComponentPointer, returns: bool, early_return: *mut Boolean) -> Status {
    let body = |instance: &mut Instance, host: &HostMemory| {
        instance.now.phase = Phase::StepComplete;
        if returns {
            // SAFETY: the host's promise, see `calls`
            unsafe { host.output_value("earlyReturn", early_return) }?.write(1);
        }
        Ok(())
    };
    // SAFETY: as above
    unsafe { run(c, &CONTINUE_STEP, body) }
}

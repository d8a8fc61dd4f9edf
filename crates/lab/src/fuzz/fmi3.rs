//! Table of the functions of FMI 3.0, each with its weight, the kind of its instance, and its random call.

use std::ffi::{CStr, CString, c_void};
use std::ptr;

use bevel_differential::fmi3::variables::planet_count;
use bevel_differential::fmi3::*;
use bevel_differential::instance::EVENT_INDICATORS;
use bevel_differential::model::STATES;
use bevel_differential::variables::{Access, guid, table};

use super::arguments::{CallResult, VariableKind as V, row};
use super::calls::*;
use super::host::{Host, InstanceOptions, Line};
use super::interface::Interface;
use super::site::Site;
use super::states;
use super::version::{EXCHANGE, Function, STEPS, Version, functions};
use crate::random::Draws;

/// The host ends a step early at every update whose number is a multiple of this.
const EARLY: u64 = 17;

/// Calls a function for an unused type, with its further arguments.
macro_rules! none {
    ($function:ident($($further:expr),*)) => { |s| none(s, |c, v, n| unsafe { $function(c, v, n, $($further),*) }) };
}

/// Calls a getter or setter of `shape` on variables of a kind.
macro_rules! values {
    ($shape:ident, $kind:expr, $function:ident) => {
        |s| $shape(s, $kind, |c, v, n, x, m| unsafe { $function(c, v, n, x, m) })
    };
}

// SAFETY of all calls: as in `calls`

/// Functions of FMI 3.0.
pub static VERSION: Version = Version {
    functions: functions! {
        fmi3GetVersion 1 None: text;
        fmi3SetDebugLogging 3 None: logging;
        fmi3InstantiateModelExchange 1 None, |s| instantiate(s, |r, name, token, host, log| unsafe {
            fmi3InstantiateModelExchange(name, token, ptr::null(), 0, r.u8(..), host, log)
        });
        fmi3InstantiateCoSimulation 1 None, |s| instantiate(s, |r, name, token, host, log| unsafe {
            let [events, early, logs] = [r.u8(..), r.u8(..), r.u8(..)];
            fmi3InstantiateCoSimulation(name, token, ptr::null(), 0, logs, events, early, ptr::null(), 0, host, log, None)
        });
        fmi3InstantiateScheduledExecution 1 None, |s| {
            let host = &*s.instance.host;
            let null = ptr::null();
            // SAFETY: all pointers are NULL or valid during the call
            let c = unsafe {
                fmi3InstantiateScheduledExecution(null, null, null, 0, 0, environment(host), Some(log), ptr::null(), ptr::null(), ptr::null())
            };
            let silent = host.recorder.lines().is_empty();
            s.result(Status::Ok).unless(!c.is_null() || silent, "an instance was made, or refused without a line in the log")
        };
        fmi3FreeInstance 1 None, |s| free(s);
        fmi3EnterInitializationMode 6 None: setup;
        fmi3ExitInitializationMode 4 None: plain;
        fmi3EnterConfigurationMode 3 None: plain;
        fmi3ExitConfigurationMode 6 None: plain;
        fmi3Terminate 1 None: plain;
        fmi3Reset 1 None, reset;
        fmi3GetFloat32 1 None, none!(fmi3GetFloat32(ptr::null_mut(), 0));
        fmi3GetFloat64 20 None, |s| {
            if s.r.chance(5) {
                return get_array(s, |c, v, n, x, m| unsafe { fmi3GetFloat64(c, v, n, x, m) });
            }
            get_reals(s, V::Float64, |c, v, n, x, m| unsafe { fmi3GetFloat64(c, v, n, x, m) })
        };
        fmi3GetInt8 1 None, none!(fmi3GetInt8(ptr::null_mut(), 0));
        fmi3GetUInt8 1 None, none!(fmi3GetUInt8(ptr::null_mut(), 0));
        fmi3GetInt16 1 None, none!(fmi3GetInt16(ptr::null_mut(), 0));
        fmi3GetUInt16 1 None, none!(fmi3GetUInt16(ptr::null_mut(), 0));
        fmi3GetInt32 4 None, values!(get, V::Int32, fmi3GetInt32);
        fmi3GetUInt32 1 None, none!(fmi3GetUInt32(ptr::null_mut(), 0));
        fmi3GetInt64 4 None, values!(get, V::Enumeration, fmi3GetInt64);
        fmi3GetUInt64 2 None, values!(get, V::Structural, fmi3GetUInt64);
        fmi3GetBoolean 5 None, values!(get, V::Boolean, fmi3GetBoolean);
        fmi3GetString 3 None, values!(get, V::Text, fmi3GetString);
        fmi3GetBinary 1 None, none!(fmi3GetBinary(ptr::null(), ptr::null(), 0));
        fmi3GetClock 1 None, none!(fmi3GetClock(ptr::null_mut()));
        fmi3SetFloat32 1 None, none!(fmi3SetFloat32(ptr::null(), 0));
        fmi3SetFloat64 20 None, |s| set_reals(s, |c, v, n, x, m| unsafe { fmi3SetFloat64(c, v, n, x, m) });
        fmi3SetInt8 1 None, none!(fmi3SetInt8(ptr::null(), 0));
        fmi3SetUInt8 1 None, none!(fmi3SetUInt8(ptr::null(), 0));
        fmi3SetInt16 1 None, none!(fmi3SetInt16(ptr::null(), 0));
        fmi3SetUInt16 1 None, none!(fmi3SetUInt16(ptr::null(), 0));
        fmi3SetInt32 4 None, values!(set, V::Int32, fmi3SetInt32);
        fmi3SetUInt32 1 None, none!(fmi3SetUInt32(ptr::null(), 0));
        fmi3SetInt64 4 None, values!(set, V::Enumeration, fmi3SetInt64);
        fmi3SetUInt64 3 None, values!(set, V::Structural, fmi3SetUInt64);
        fmi3SetBoolean 5 None, values!(set, V::Boolean, fmi3SetBoolean);
        fmi3SetString 3 None, none!(fmi3SetString(ptr::null(), 0));
        fmi3SetBinary 1 None, none!(fmi3SetBinary(ptr::null(), ptr::null(), 0));
        fmi3SetClock 1 None, none!(fmi3SetClock(ptr::null()));
        fmi3GetNumberOfVariableDependencies 1 None, |s| never(s, |c| unsafe {
            fmi3GetNumberOfVariableDependencies(c, 0, &mut 0)
        });
        fmi3GetVariableDependencies 1 None, |s| never(s, |c| unsafe {
            let null = ptr::null_mut();
            fmi3GetVariableDependencies(c, 0, null, ptr::null_mut(), null, ptr::null_mut(), 0)
        });
        fmi3GetFMUState 6 None, states::get_state;
        fmi3SetFMUState 6 None, states::set_state;
        fmi3FreeFMUState 5 None, states::free_state;
        fmi3SerializedFMUStateSize 5 None, states::state_size;
        fmi3SerializeFMUState 5 None, states::serialize;
        fmi3DeserializeFMUState 12 None, states::deserialize;
        fmi3GetDirectionalDerivative 12 None, |s| sensitivity(s, false, |c, v, n, by, m, along, l, x, k| unsafe {
            fmi3GetDirectionalDerivative(c, v, n, by, m, along, l, x, k)
        });
        fmi3GetAdjointDerivative 8 None, |s| sensitivity(s, true, |c, v, n, by, m, along, l, x, k| unsafe {
            fmi3GetAdjointDerivative(c, v, n, by, m, along, l, x, k)
        });
        fmi3GetIntervalDecimal 1 None, none!(fmi3GetIntervalDecimal(ptr::null_mut(), ptr::null_mut()));
        fmi3GetIntervalFraction 1 None,
            none!(fmi3GetIntervalFraction(ptr::null_mut(), ptr::null_mut(), ptr::null_mut()));
        fmi3GetShiftDecimal 1 None, none!(fmi3GetShiftDecimal(ptr::null_mut()));
        fmi3GetShiftFraction 1 None, none!(fmi3GetShiftFraction(ptr::null_mut(), ptr::null_mut()));
        fmi3SetIntervalDecimal 1 None, none!(fmi3SetIntervalDecimal(ptr::null()));
        fmi3SetIntervalFraction 1 None, none!(fmi3SetIntervalFraction(ptr::null(), ptr::null()));
        fmi3SetShiftDecimal 1 None, none!(fmi3SetShiftDecimal(ptr::null()));
        fmi3SetShiftFraction 1 None, none!(fmi3SetShiftFraction(ptr::null(), ptr::null()));
        fmi3EvaluateDiscreteStates 3 None: plain;
        fmi3UpdateDiscreteStates 10 None, update_discrete_states;
        fmi3EnterEventMode 6 None: plain;
        fmi3EnterStepMode 15 STEPS: plain;
        fmi3EnterContinuousTimeMode 15 EXCHANGE: plain;
        fmi3CompletedIntegratorStep 20 EXCHANGE: completed;
        fmi3SetTime 15 EXCHANGE: set_time;
        fmi3SetContinuousStates 15 EXCHANGE: set_states;
        fmi3GetContinuousStateDerivatives 15 EXCHANGE: fill(STATES);
        fmi3GetEventIndicators 15 EXCHANGE: fill(EVENT_INDICATORS);
        fmi3GetContinuousStates 10 EXCHANGE: fill(STATES);
        fmi3GetNominalsOfContinuousStates 4 None: fill(STATES);
        fmi3GetNumberOfEventIndicators 2 None: number(EVENT_INDICATORS);
        fmi3GetNumberOfContinuousStates 2 None: number(STATES);
        fmi3GetOutputDerivatives 15 STEPS, |s| get_rates(s, |c, v, n, orders, x, m| unsafe {
            fmi3GetOutputDerivatives(c, v, n, orders, x, m)
        });
        fmi3DoStep 40 STEPS, |s| step(s, do_step);
        fmi3ActivateModelPartition 1 None, |s| never(s, |c| unsafe { fmi3ActivateModelPartition(c, 0, 0.0) });
    },
    interface: Interface {
        number: 3,
        make,
        free: fmi3FreeInstance,
        reset: fmi3Reset,
        log_all: |c| unsafe { fmi3SetDebugLogging(c, 0, 0, ptr::null()) },
        initialise: |c| unsafe { [fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0), fmi3ExitInitializationMode(c)] },
        run: |c, kind| unsafe {
            let ([mut a, mut b, mut d, mut e, mut f], mut next) = ([0; 5], 0.0);
            fmi3UpdateDiscreteStates(c, &mut a, &mut b, &mut d, &mut e, &mut f, &mut next);
            if kind == Kind::ModelExchange {
                fmi3EnterContinuousTimeMode(c)
            } else {
                fmi3EnterStepMode(c)
            };
        },
        time: |c, now| unsafe { fmi3GetFloat64(c, &(table().rows.len() as u32), 1, now, 1) },
        step: |c, point, h| unsafe {
            let ([mut event, mut end, mut early], mut last) = ([0; 3], 0.0);
            fmi3DoStep(c, point, h, 1, &mut event, &mut end, &mut early, &mut last)
        },
        set_real: |c, v, x| unsafe { fmi3SetFloat64(c, &v, 1, &x, 1) },
        set_integer,
        set_boolean: |c, v, x| unsafe { fmi3SetBoolean(c, &v, 1, &u8::from(x), 1) },
        get_reals: |c, v, n, x| unsafe { fmi3GetFloat64(c, v, n, x, n) },
        get_states: fmi3GetContinuousStates,
        get_rates: fmi3GetContinuousStateDerivatives,
        get_indicators: fmi3GetEventIndicators,
        get_state: fmi3GetFMUState,
        set_state: fmi3SetFMUState,
        free_state: fmi3FreeFMUState,
        state_size: fmi3SerializedFMUStateSize,
        serialize: |c, state, bytes, size| unsafe { fmi3SerializeFMUState(c, state, bytes, size) },
        deserialize: |c, bytes, size, state| unsafe { fmi3DeserializeFMUState(c, bytes, size, state) },
    },
};

/// Pointer that is passed along with messages and updates.
fn environment(host: &Host) -> *mut c_void {
    ptr::from_ref(host).cast_mut().cast()
}

fn make(options: &InstanceOptions, host: &Host) -> ComponentPointer {
    let (name, token) = (c"unit".as_ptr(), CString::new(guid()).unwrap_or_default());
    let (place, logs) = (environment(host), u8::from(options.logs));
    // SAFETY: all pointers are valid during the call, and the host as long as the instance
    unsafe {
        if options.kind == Kind::ModelExchange {
            return fmi3InstantiateModelExchange(name, token.as_ptr(), ptr::null(), 0, logs, place, Some(log));
        }
        let updates = options.updates.then_some(update as IntermediateUpdate);
        let [events, early] = [options.events, options.early].map(u8::from);
        let token = token.as_ptr();
        fmi3InstantiateCoSimulation(
            name,
            token,
            ptr::null(),
            0,
            logs,
            events,
            early,
            ptr::null(),
            0,
            place,
            Some(log),
            updates,
        )
    }
}

/// Records a line of the log.
unsafe extern "C" fn log(environment: *mut c_void, status: Status, category: Text, message: Text) {
    // SAFETY: `environment` is the host, which outlives the instance; the strings come from the FMU
    let (host, [category, message]) = unsafe {
        (&*environment.cast::<Host>(), [category, message].map(|text| CStr::from_ptr(text).to_string_lossy()))
    };
    host.recorder.lines().push(Line { status, category: category.into_owned(), message: message.into_owned() });
}

/// Reads variables during a step, and sometimes ends the step.
unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    _may_set: Boolean,
    may_get: Boolean,
    _is_finished: Boolean,
    _may_return: Boolean,
    early: *mut Boolean,
    _early_time: *mut f64,
) {
    // SAFETY: `environment` is the host, which outlives the instance; `early` is the library's
    let host = unsafe { &*environment.cast::<Host>() };
    let count = host.updates.get() + 1;
    host.updates.set(count);
    let mut numbers = [f64::NAN; 4];
    let references: Vec<u32> = table().real_outputs().cycle().skip(count as usize % 97).take(3).collect();
    let references = [table().rows.len() as u32, references[0], references[1], references[2]];
    // SAFETY: a live instance, and room for the values
    let status = unsafe { fmi3GetFloat64(host.component.get(), references.as_ptr(), 4, numbers.as_mut_ptr(), 4) };
    let is_time = numbers[0].to_bits() == time.to_bits();
    if status != Status::Ok || may_get != 1 || !is_time || numbers.iter().any(|number| !number.is_finite()) {
        let found = format!("in an update at {time}, {references:?} were read with {status:?}: {numbers:?}");
        *host.broken.borrow_mut() = Some(found);
    }
    // SAFETY: a variable of the library
    unsafe { *early = Boolean::from(count.is_multiple_of(EARLY)) };
}

/// Sets an integer: the number of planets in configuration mode, and enumerations as enumerations.
unsafe fn set_integer(c: ComponentPointer, v: u32, x: i32) -> Status {
    // SAFETY: the caller's promise
    unsafe {
        if v == planet_count() {
            fmi3EnterConfigurationMode(c);
            let status = fmi3SetUInt64(c, &v, 1, &u64::from(x.unsigned_abs()), 1);
            fmi3ExitConfigurationMode(c);
            return status;
        }
        match row(v).map(|row| row.access) {
            Some(Access::Enumeration(..)) => fmi3SetInt64(c, &v, 1, &i64::from(x), 1),
            _ => fmi3SetInt32(c, &v, 1, &x, 1),
        }
    }
}

/// Calls a function that every state refuses.
fn never(s: &mut Site, function: unsafe fn(ComponentPointer) -> Status) -> CallResult {
    s.flaws.any = true;
    let status = unsafe { function(s.c) };
    s.result(status)
}

/// Reads a number that never changes.
fn number(
    s: &mut Site,
    right: usize,
    function: unsafe extern "C" fn(ComponentPointer, *mut usize) -> Status,
) -> CallResult {
    let mut count = usize::MAX;
    let place = s.place(&raw mut count, true);
    let status = unsafe { function(s.c, place) };
    s.result(status).unless(count != right, "a wrong number")
}

fn update_discrete_states(s: &mut Site) -> CallResult {
    let (mut flags, mut next) = ([9u8; 5], f64::NAN);
    let mut places = flags.each_mut().map(ptr::from_mut);
    if s.r.chance(20) {
        s.flaws.any = true;
        places[s.r.below(5)] = ptr::null_mut();
    }
    let ([a, b, d, e, f], time) = (places, s.place(&raw mut next, true));
    let status = unsafe { fmi3UpdateDiscreteStates(s.c, a, b, d, e, f, time) };
    s.result(status).with(&[next]).unless(flags.contains(&9), "a flag was not written")
}

fn do_step(s: &mut Site, point: f64, h: f64) -> Ended {
    let (mut event, mut end, mut early, mut last) = (9u8, 9u8, 9u8, f64::NAN);
    let (event, end, flag) =
        (s.place(&raw mut event, true), s.place(&raw mut end, true), s.place(&raw mut early, true));
    let reached = s.place(&raw mut last, true);
    let status = unsafe { fmi3DoStep(s.c, point, h, s.r.u8(..2), event, end, flag, reached) };
    (status, Some(last), early == 1)
}

/// Creates an instance of either kind with random name and token. A created instance is freed.
fn instantiate(
    s: &mut Site,
    function: fn(&mut fastrand::Rng, Text, Text, *mut c_void, Option<LogMessage>) -> ComponentPointer,
) -> CallResult {
    let right = CString::new(guid()).unwrap_or_default();
    let (([name, token], is_right), is_logged) = (name_and_token(s.r, &right), !s.r.chance(4));
    let host = &*s.instance.host;
    let message = is_logged.then_some(log as LogMessage);
    let c = function(s.r, name, token, environment(host), message);
    let outcome = instantiated(c, is_right, is_logged && host.recorder.lines().is_empty());
    // SAFETY: NULL, or an instance that nothing else uses
    unsafe { fmi3FreeInstance(c) };
    outcome
}

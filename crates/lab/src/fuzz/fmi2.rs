//! Table of the functions of FMI 2.0, each with its weight, the kind of its instance, and its random call.

use std::ffi::CString;
use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::instance::Kind;
use bevel_differential::model::STATES;
use bevel_differential::variables::guid;

use super::arguments::{CallResult, VariableKind as V};
use super::calls::*;
use super::host::{Host, InstanceOptions, Recorder};
use super::interface::Interface;
use super::site::Site;
use super::states;
use super::version::{EXCHANGE, Function, STEPS, Version, functions};
use crate::random::Draws;

// SAFETY of all calls: as in `calls`

/// Functions of FMI 2.0.
pub static VERSION: Version = Version {
    functions: functions! {
        fmi2GetTypesPlatform 1 None: text;
        fmi2GetVersion 1 None: text;
        fmi2Instantiate 2 None, instantiate;
        fmi2FreeInstance 1 None, |s| free(s);
        fmi2SetDebugLogging 3 None: logging;
        fmi2SetupExperiment 4 None: setup;
        fmi2EnterInitializationMode 4 None: plain;
        fmi2ExitInitializationMode 4 None: plain;
        fmi2Terminate 1 None: plain;
        fmi2Reset 1 None, reset;
        fmi2GetReal 20 None, |s| get_reals(s, V::Real, |c, v, n, x, _| unsafe { fmi2GetReal(c, v, n, x) });
        fmi2GetInteger 5 None, |s| get(s, V::Integer, |c, v, n, x, _| unsafe { fmi2GetInteger(c, v, n, x) });
        fmi2GetBoolean 5 None, |s| get(s, V::Boolean, |c, v, n, x, _| unsafe { fmi2GetBoolean(c, v, n, x) });
        fmi2GetString 3 None, |s| none(s, |c, v, n| unsafe { fmi2GetString(c, v, n, ptr::null_mut()) });
        fmi2SetReal 20 None, |s| set_reals(s, |c, v, n, x, _| unsafe { fmi2SetReal(c, v, n, x) });
        fmi2SetInteger 5 None, |s| set(s, V::Integer, |c, v, n, x, _| unsafe { fmi2SetInteger(c, v, n, x) });
        fmi2SetBoolean 5 None, |s| set(s, V::Boolean, |c, v, n, x, _| unsafe { fmi2SetBoolean(c, v, n, x) });
        fmi2SetString 3 None, |s| none(s, |c, v, n| unsafe { fmi2SetString(c, v, n, ptr::null()) });
        fmi2GetFMUstate 6 None, states::get_state;
        fmi2SetFMUstate 6 None, states::set_state;
        fmi2FreeFMUstate 5 None, states::free_state;
        fmi2SerializedFMUstateSize 5 None, states::state_size;
        fmi2SerializeFMUstate 5 None, states::serialize;
        fmi2DeSerializeFMUstate 12 None, states::deserialize;
        fmi2GetDirectionalDerivative 15 None, |s| sensitivity(s, false, |c, v, n, by, m, along, _, x, _| unsafe {
            fmi2GetDirectionalDerivative(c, v, n, by, m, along, x)
        });
        fmi2EnterEventMode 6 EXCHANGE: plain;
        fmi2NewDiscreteStates 10 EXCHANGE, discrete;
        fmi2EnterContinuousTimeMode 15 EXCHANGE: plain;
        fmi2CompletedIntegratorStep 20 EXCHANGE: completed;
        fmi2SetTime 15 EXCHANGE: set_time;
        fmi2SetContinuousStates 15 EXCHANGE: set_states;
        fmi2GetDerivatives 15 EXCHANGE: fill(STATES);
        fmi2GetEventIndicators 15 EXCHANGE: fill(EVENT_INDICATORS);
        fmi2GetContinuousStates 10 EXCHANGE: fill(STATES);
        fmi2GetNominalsOfContinuousStates 4 None: fill(STATES);
        fmi2SetRealInputDerivatives 8 STEPS, |s| set_rates(s, |c, v, n, orders, x| unsafe {
            fmi2SetRealInputDerivatives(c, v, n, orders, x)
        });
        fmi2GetRealOutputDerivatives 15 STEPS, |s| get_rates(s, |c, v, n, orders, x, _| unsafe {
            fmi2GetRealOutputDerivatives(c, v, n, orders, x)
        });
        fmi2DoStep 40 STEPS, |s| step(s, |s, point, h| {
            (unsafe { fmi2DoStep(s.c, point, h, s.r.below(2) as i32) }, None, false)
        });
        fmi2CancelStep 2 STEPS: plain;
        fmi2GetStatus 4 None: status_of(Status::Ok);
        fmi2GetRealStatus 4 None, |s| {
            let mut number = f64::NAN;
            let place = s.place(&raw mut number, true);
            let status = unsafe { fmi2GetRealStatus(s.c, a_kind(s), place) };
            s.result(status).with(&[number])
        };
        fmi2GetIntegerStatus 2 None, |s| {
            let status = unsafe { fmi2GetIntegerStatus(s.c, a_kind(s), &mut 0) };
            s.result(status)
        };
        fmi2GetBooleanStatus 3 None: status_of(0);
        fmi2GetStringStatus 3 None, |s| {
            let mut text = ptr::null();
            let place = s.place(&raw mut text, true);
            let status = unsafe { fmi2GetStringStatus(s.c, a_kind(s), place) };
            s.result(status).unless(text.is_null(), "NULL")
        };
    },
    interface: Interface {
        number: 2,
        make,
        free: fmi2FreeInstance,
        reset: fmi2Reset,
        log_all: |c| unsafe { fmi2SetDebugLogging(c, 0, 0, ptr::null()) },
        initialise: |c| unsafe {
            fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0);
            [fmi2EnterInitializationMode(c), fmi2ExitInitializationMode(c)]
        },
        run: |c, kind| {
            if kind == Kind::ModelExchange {
                unsafe {
                    fmi2NewDiscreteStates(c, &mut EventInfo::default());
                    fmi2EnterContinuousTimeMode(c);
                }
            }
        },
        time: |c, now| unsafe { fmi2GetRealStatus(c, LAST_SUCCESSFUL_TIME, now) },
        step: |c, point, h| unsafe { fmi2DoStep(c, point, h, 1) },
        set_real: |c, v, x| unsafe { fmi2SetReal(c, &v, 1, &x) },
        set_integer: |c, v, x| unsafe { fmi2SetInteger(c, &v, 1, &x) },
        set_boolean: |c, v, x| unsafe { fmi2SetBoolean(c, &v, 1, &i32::from(x)) },
        get_reals: |c, v, n, x| unsafe { fmi2GetReal(c, v, n, x) },
        get_states: fmi2GetContinuousStates,
        get_rates: fmi2GetDerivatives,
        get_indicators: fmi2GetEventIndicators,
        get_state: fmi2GetFMUstate,
        set_state: fmi2SetFMUstate,
        free_state: fmi2FreeFMUstate,
        state_size: fmi2SerializedFMUstateSize,
        serialize: |c, state, bytes, size| unsafe { fmi2SerializeFMUstate(c, state, bytes.cast(), size) },
        deserialize: |c, bytes, size, state| unsafe { fmi2DeSerializeFMUstate(c, bytes.cast(), size, state) },
    },
};

fn make(options: &InstanceOptions, host: &Host) -> ComponentPointer {
    let (token, callbacks) = (CString::new(guid()).unwrap_or_default(), host.recorder.callbacks());
    let logs = i32::from(options.logs);
    // SAFETY: all pointers are valid during the call, and the host as long as the instance
    unsafe { fmi2Instantiate(c"unit".as_ptr(), options.kind as i32, token.as_ptr(), ptr::null(), &callbacks, 0, logs) }
}

fn discrete(s: &mut Site) -> CallResult {
    let mut info = EventInfo { next_event: f64::NAN, ..EventInfo::default() };
    let place = s.place(&raw mut info, true);
    let status = unsafe { fmi2NewDiscreteStates(s.c, place) };
    s.result(status).with(&[info.next_event])
}

fn a_kind(s: &mut Site) -> i32 {
    if s.r.chance(8) { s.r.i32(..) } else { s.r.below(4) as i32 }
}

/// Requests a status of any kind.
fn status_of<T>(
    s: &mut Site,
    mut value: T,
    function: unsafe extern "C" fn(ComponentPointer, i32, *mut T) -> Status,
) -> CallResult {
    let place = s.place(&raw mut value, true);
    let status = unsafe { function(s.c, a_kind(s), place) };
    s.result(status)
}

/// Calls fmi2Instantiate with random arguments. A created instance is freed.
fn instantiate(s: &mut Site) -> CallResult {
    let (recorder, r) = (Recorder::default(), &mut *s.r);
    let callbacks = recorder.callbacks();
    let right = CString::new(guid()).unwrap_or_default();
    let kind = r.below(4) as i32 - 1;
    let ([name, token], is_right) = name_and_token(r, &right);
    let places = [ptr::null(), c"file:///a%20b".as_ptr(), c"\xff".as_ptr()];
    let callbacks = if r.chance(4) { ptr::null() } else { &raw const callbacks };
    // SAFETY: all pointers are NULL or valid during the call
    let c = unsafe { fmi2Instantiate(name, kind, token, r.pick(&places), callbacks, 0, r.below(2) as i32) };
    let is_right = is_right && (kind == MODEL_EXCHANGE || kind == CO_SIMULATION);
    let outcome = instantiated(c, is_right, recorder.lines().is_empty() && !callbacks.is_null());
    // SAFETY: NULL, or a component that nothing else uses; it is freed before its log
    unsafe { fmi2FreeInstance(c) };
    outcome
}

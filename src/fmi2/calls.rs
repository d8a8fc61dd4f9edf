//! Table of the C functions that are called on an instance: name, arguments, states in which the call is legal, and
//! what the call does. The states are those of FMI 2.0.4, sections 3.2.3 (model exchange) and 4.2.4 (co-simulation).
//! The other functions are in `special`.
//!
//! # Safety
//! These rules apply to all functions. A component comes from `fmi2Instantiate` and was not freed. Every pointer that
//! is not NULL points to what FMI 2.0 specifies for as long as the call lasts. NULL and misaligned pointers are refused
//! if FMI requires a value.

#![allow(clippy::missing_safety_doc)] // the section above applies to all
#![allow(non_snake_case)] // FMI's names

use super::types::{self, *};
use crate::instance::c_types::{c_char, c_int};
use crate::instance::states::{
    COMPLETE, CONFIGURATION, CONTINUOUS, ERROR, EVENT, FAILED, INITIALIZATION, INSTANTIATED, INTERMEDIATE, TERMINATED,
};
use crate::instance::values::{all_or_none, string_error};
use crate::instance::{CallError, CallResult, Experiment, InputArray, Output, Phase, calls, states};
#[cfg(feature = "full")]
use crate::instance::{Instance, completed_step, filled};
use crate::model::Simulation;

/// No state: fmi2CancelStep is never legal, because steps are synchronous.
const NEVER: u16 = 0;
const ALWAYS: u16 = states::ALWAYS & !CONFIGURATION & !INTERMEDIATE;
const CAN_SET: u16 = INSTANTIATED | INITIALIZATION | COMPLETE | EVENT;
/// States in which the host may ask about a step.
const HAS_STEPPED: u16 = COMPLETE | FAILED | TERMINATED;
/// States in which the continuous states, their derivatives and the event indicators have values.
#[cfg(feature = "full")]
const HAS_STATES: u16 = INITIALIZATION | EVENT | CONTINUOUS | TERMINATED | ERROR;

calls! {
    2 |instance, host| []
    (true) {
        /// An empty list of categories means all.
        // SAFETY: the host's promise, see the module
        fmi2SetDebugLogging(loggingOn: Boolean, nCategories: usize, categories: *const Text as input[nCategories]) ALWAYS =>
            unsafe { instance.configure_log(host, loggingOn != 0, categories) };
        fmi2SetupExperiment(
            toleranceDefined: Boolean, tolerance: f64, startTime: f64, stopTimeDefined: Boolean, stopTime: f64
        ) INSTANTIATED => instance.setup_experiment(&Experiment {
            tolerance: (toleranceDefined != 0).then_some(tolerance),
            start: startTime,
            stop: (stopTimeDefined != 0).then_some(stopTime),
        });
        fmi2EnterInitializationMode() INSTANTIATED => instance.enter_initialization();
        fmi2ExitInitializationMode() INITIALIZATION => instance.exit_initialization();
        fmi2Terminate() COMPLETE | FAILED | EVENT | CONTINUOUS => instance.terminate();
        fmi2Reset() ALWAYS => instance.reset();

        // outputs have values only from initialization mode on
        fmi2GetReal(vr: *const ValueReference as input[nvr], nvr: usize, value: *mut f64 as output[nvr]) ALWAYS =>
            instance.get_real(vr.iter(), value.iter());
        fmi2GetInteger(vr: *const ValueReference as input[nvr], nvr: usize, value: *mut c_int as output[nvr]) ALWAYS =>
            value.write_each(vr, |vr| instance.get_integer(vr));
        fmi2GetBoolean(vr: *const ValueReference as input[nvr], nvr: usize, value: *mut Boolean as output[nvr]) ALWAYS =>
            value.write_each(vr, |vr| instance.get_boolean(vr).map(Boolean::from));
        fmi2GetString(vr: *const ValueReference as input[nvr], nvr: usize, _value: *mut Text) ALWAYS => no_strings(vr);
        // `instance::values` refuses most variables in some of these states
        fmi2SetReal(vr: *const ValueReference as input[nvr], nvr: usize, value: *const f64 as input[nvr]) CAN_SET | CONTINUOUS =>
            all_or_none(nvr, instance.set_real(vr, value));
        fmi2SetInteger(vr: *const ValueReference as input[nvr], nvr: usize, value: *const c_int as input[nvr]) CAN_SET =>
            all_or_none(nvr, instance.set_integer(vr.iter().zip(value.iter())));
        fmi2SetBoolean(vr: *const ValueReference as input[nvr], nvr: usize, value: *const Boolean as input[nvr]) CAN_SET =>
            all_or_none(nvr, instance.set_boolean(vr.iter().zip(value.iter().map(|value| value != 0))));
        fmi2SetString(vr: *const ValueReference as input[nvr], nvr: usize, _value: *const Text) CAN_SET => no_strings(vr);

        // SAFETY of the following rows: the host's promise, see the module
        /// An existing state is overwritten.
        // after an error, the state may be invalid
        fmi2GetFMUstate(state: *mut FmuState) ALWAYS & !ERROR => unsafe { instance.get_state(host, state) };
        fmi2SetFMUstate(state: FmuState) ALWAYS => unsafe { instance.set_state(host, state) };
        /// NULL is accepted.
        fmi2FreeFMUstate(state: *mut FmuState) ALWAYS => unsafe { instance.free_state(host, state) };
        fmi2SerializedFMUstateSize(state: FmuState, size: *mut usize) ALWAYS =>
            unsafe { instance.serialized_size(host, state, size) };
        /// `size` must be the size that fmi2SerializedFMUstateSize returned.
        fmi2SerializeFMUstate(state: FmuState, bytes: *mut c_char, size: usize) ALWAYS =>
            unsafe { instance.serialize(host, state, bytes.cast(), size) };
        /// Invalid bytes change nothing.
        fmi2DeSerializeFMUstate(bytes: *const c_char, size: usize, state: *mut FmuState) ALWAYS =>
            unsafe { instance.deserialize(host, bytes.cast(), size, state) };

        fmi2GetDirectionalDerivative(
            vUnknown_ref: *const ValueReference as input[nUnknown], nUnknown: usize,
            vKnown_ref: *const ValueReference as input[nKnown], nKnown: usize,
            dvKnown: *const f64 as input[nKnown], dvUnknown: *mut f64 as output[nUnknown]
        ) ALWAYS & !INSTANTIATED =>
            instance.get_directional_derivative(vUnknown_ref.iter(), vKnown_ref.iter().zip(dvKnown.iter()), dvUnknown.iter());
        fmi2SetRealInputDerivatives(
            vr: *const ValueReference as input[nvr], nvr: usize, order: *const c_int as input[nvr], value: *const f64 as input[nvr]
        ) INSTANTIATED | INITIALIZATION | COMPLETE => all_or_none(nvr, instance.set_input_derivatives(vr, order, value));
        fmi2GetRealOutputDerivatives(
            vr: *const ValueReference as input[nvr], nvr: usize, order: *const c_int as input[nvr], value: *mut f64 as output[nvr]
        ) HAS_STEPPED | ERROR => instance.get_output_derivatives(vr.iter().zip(order.iter()), value.iter());

        /// The flag is ignored, because snapshots are complete even if the host goes back in time.
        fmi2DoStep(point: f64, size: f64, _noSetFMUStatePriorToCurrentPoint: Boolean) COMPLETE => instance.do_step(point, size);
        /// Steps are synchronous, so there is never a step to cancel.
        fmi2CancelStep() NEVER => Ok(());
        fmi2GetStatus(s: c_int, value: *mut Status as output_value) HAS_STEPPED => {
            let is_failed = instance.now.phase == Phase::StepFailed;
            let status = if is_failed { Status::Discard } else { Status::Ok };
            available(s, value, (s == DO_STEP_STATUS).then_some(status))
        };
        /// The only real status is the last successful time.
        fmi2GetRealStatus(s: c_int, value: *mut f64 as output_value) HAS_STEPPED => {
            let simulation = instance.now.simulation.as_ref().filter(|_| s == LAST_SUCCESSFUL_TIME);
            available(s, value, simulation.map(Simulation::time))
        };
        /// FMI defines no integer status.
        fmi2GetIntegerStatus(s: c_int, _value: *mut c_int) HAS_STEPPED => Err(no_such_status(s));
        /// The FMU never requests the end of the simulation.
        fmi2GetBooleanStatus(s: c_int, value: *mut Boolean as output_value) HAS_STEPPED =>
            available(s, value, (s == types::TERMINATED).then_some(0));
        /// Nothing is ever pending.
        fmi2GetStringStatus(s: c_int, value: *mut Text as output_value) HAS_STEPPED =>
            available(s, value, (s == PENDING_STATUS).then_some(c"no step is pending".as_ptr()));
    }
    (feature = "full") {
        fmi2EnterEventMode() EVENT | CONTINUOUS => instance.enter_event_mode();
        fmi2NewDiscreteStates(fmi2EventInfo: *mut EventInfo as output_value) EVENT => {
            let update = instance.new_discrete_states()?;
            fmi2EventInfo.write(EventInfo {
                states_changed: update.states_changed.into(),
                next_event_defined: update.next.is_some().into(),
                next_event: update.next.unwrap_or(0.0),
                ..EventInfo::default()
            });
            Ok(())
        };
        fmi2EnterContinuousTimeMode() EVENT => instance.enter_continuous_time_mode();
        /// The flag is ignored, because snapshots are complete.
        fmi2CompletedIntegratorStep completed_step!() CONTINUOUS => Instance::completed_integrator_step;
        fmi2SetTime(time: f64) EVENT | CONTINUOUS => instance.set_time(time);
        fmi2SetContinuousStates(x: *const f64 as input[nx], nx: usize) CONTINUOUS => instance.set_continuous_states(x);
        fmi2GetDerivatives filled!() HAS_STATES => Instance::get_derivatives;
        fmi2GetEventIndicators filled!() HAS_STATES => Instance::get_event_indicators;
        fmi2GetContinuousStates filled!() HAS_STATES => Instance::get_continuous_states;
        fmi2GetNominalsOfContinuousStates filled!() ALWAYS => Instance::get_nominals;
    }
}

/// Accepts no references, because there are no String variables.
fn no_strings(references: InputArray<ValueReference>) -> CallResult {
    references.iter().next().map_or(Ok(()), |reference| Err(string_error(reference)))
}

/// Writes the status of a kind, if it is available.
fn available<T>(kind: c_int, target: Output<T>, status: Option<T>) -> CallResult {
    target.write(status.ok_or_else(|| no_such_status(kind))?);
    Ok(())
}

/// Returns the error for an unavailable status. FMI requires fmi2Discard.
fn no_such_status(kind: c_int) -> CallError {
    CallError::discard(format!("the status of kind {kind} is not available"))
}

//! Table of the C functions that are called on an instance: name, arguments, states in which the call is legal, and
//! what the call does. The states are those of FMI 3.0.2, sections 3.2 (model exchange) and 4.2 (co-simulation). The
//! other functions are in `special`, with fmi3DoStep, which may be several calls.
//!
//! # Safety
//! These rules apply to all functions. An instance comes from `fmi3Instantiate…` and was not freed. Every pointer that
//! is not NULL points to what FMI 3.0 specifies for as long as the call lasts. NULL and misaligned pointers are refused
//! if FMI requires a value.

#![allow(clippy::missing_safety_doc)] // the section above applies to all
#![allow(non_snake_case)] // FMI's names

use super::types::*;
use super::values;
use crate::instance::c_types::{c_int, c_void};
use crate::instance::states::{
    ALWAYS, COMPLETE as STEP, CONFIGURATION, CONTINUOUS, ERROR, EVENT, FAILED, INITIALIZATION, INSTANTIATED,
    INTERMEDIATE, TERMINATED,
};
use crate::instance::values::all_or_none;
use crate::instance::{
    Call, CallError, CallResult, EVENT_INDICATORS, Experiment, Instance, Iteration, calls, completed_step, export,
    filled,
};
use crate::model::STATES;

/// States in which a variable may be set.
const CAN_SET: u16 = INSTANTIATED | CONFIGURATION | INITIALIZATION | STEP | EVENT;
/// States in which directional and adjoint derivatives have values.
const HAS_DERIVATIVES: u16 = HAS_STATES | STEP | INTERMEDIATE;
/// States in which the continuous states, their derivatives and the event indicators have values.
const HAS_STATES: u16 = INITIALIZATION | EVENT | CONTINUOUS | TERMINATED | ERROR;
/// Names of families of functions in messages.
const GET: &str = "fmi3Get of a type without variables";
const SET: &str = "fmi3Set of a type without variables";
const CLOCKS: &str = "functions of clocks";

/// fmi3DoStep when the host calls it.
pub const DO_STEP: Call = Call { version: 3, names: &["fmi3DoStep"], phases: STEP };
/// fmi3DoStep when the host has used its update within the step.
pub const CONTINUE_STEP: Call = Call { phases: INTERMEDIATE, ..DO_STEP };

/// Reads or sets variables by an array of values.
macro_rules! values {
    (($pointer:ty as $check:ident) $row:tt $method:expr) => {
        export! {
            [] (
                valueReferences: *const ValueReference as input[nValueReferences], nValueReferences: usize,
                values: $pointer as $check[nValues], nValues: usize
            )
            $row |instance, host| $method(instance, valueReferences, values)
        }
    };
}

/// Sets variables, all or none.
macro_rules! set {
    (($type:ty) $row:tt $method:expr) => {
        values! { (*const $type as input) $row |instance, references, values| {
            let outcome = $method(instance, references, values);
            all_or_none(references.len(), outcome)
        } }
    };
}

/// Refuses all variables, because there are none of the type. The arguments are those after the value references.
macro_rules! none {
    (($($argument:ident: $type:ty),*) $row:tt $wanted:expr) => {
        export! {
            [] (valueReferences: *const ValueReference as input[nValueReferences], nValueReferences: usize, $($argument: $type),*)
            $row |instance, host| values::none_of(valueReferences, $wanted)
        }
    };
}

/// Computes directional or adjoint derivatives.
macro_rules! sensitivity {
    (() $row:tt $method:expr) => {
        export! {
            [] (
                unknowns: *const ValueReference as input[nUnknowns], nUnknowns: usize,
                knowns: *const ValueReference as input[nKnowns], nKnowns: usize,
                seed: *const f64 as input[nSeed], nSeed: usize,
                sensitivity: *mut f64 as output[nSensitivity], nSensitivity: usize
            )
            $row |instance, host| $method(instance, [unknowns, knowns], seed, sensitivity)
        }
    };
}

/// Returns a number that never changes.
macro_rules! number {
    (() $row:tt $number:expr) => {
        export! {
            [] (count: *mut usize) $row |instance, host| {
                // SAFETY: the host's promise, see the module
                unsafe { host.output_value("the number", count) }?.write($number);
                Ok(())
            }
        }
    };
}

calls! {
    3 |instance, host| [DO_STEP, CONTINUE_STEP]
    (true) {
        /// An empty list of categories means all.
        // SAFETY: the host's promise, see the module
        fmi3SetDebugLogging(loggingOn: Boolean, nCategories: usize, categories: *const Text as input[nCategories]) ALWAYS =>
            unsafe { instance.configure_log(host, loggingOn != 0, categories) };
        fmi3EnterInitializationMode(
            toleranceDefined: Boolean, tolerance: f64, startTime: f64, stopTimeDefined: Boolean, stopTime: f64
        ) INSTANTIATED => {
            instance.setup_experiment(&Experiment {
                tolerance: (toleranceDefined != 0).then_some(tolerance),
                start: startTime,
                stop: (stopTimeDefined != 0).then_some(stopTime),
            })?;
            instance.enter_initialization()
        };
        fmi3ExitInitializationMode() INITIALIZATION => instance.exit_initialization();
        fmi3EnterConfigurationMode() INSTANTIATED => instance.enter_configuration();
        fmi3ExitConfigurationMode() CONFIGURATION => instance.exit_configuration();
        fmi3Terminate() STEP | FAILED | EVENT | CONTINUOUS => instance.terminate();
        fmi3Reset() ALWAYS => instance.reset();

        // outputs have values only from initialization mode on
        fmi3GetFloat64 values!(*mut f64 as output) ALWAYS => values::get_float64;
        fmi3GetInt32 values!(*mut i32 as output) ALWAYS => values::get_int32;
        fmi3GetInt64 values!(*mut i64 as output) ALWAYS => values::get_int64;
        fmi3GetUInt64 values!(*mut u64 as output) ALWAYS => values::get_uint64;
        fmi3GetBoolean values!(*mut Boolean as output) ALWAYS => values::get_boolean;
        /// The returned text is never freed.
        fmi3GetString values!(*mut Text as output) ALWAYS => values::get_string;
        fmi3SetFloat64 set!(f64) CAN_SET | INTERMEDIATE | CONTINUOUS => values::set_float64;
        fmi3SetInt32 set!(i32) CAN_SET => values::set_int32;
        fmi3SetInt64 set!(i64) CAN_SET => values::set_int64;
        fmi3SetUInt64 set!(u64) CAN_SET => values::set_uint64;
        fmi3SetBoolean set!(Boolean) CAN_SET => values::set_boolean;
        /// The only String variable is an output.
        fmi3SetString none!(_values: *const Text, _nValues: usize) CAN_SET => "settable String";

        // types and clocks that the FMU does not have
        fmi3GetFloat32 none!(_values: *mut f32, _nValues: usize) ALWAYS, GET => "Float32";
        fmi3GetInt8 none!(_values: *mut i8, _nValues: usize) ALWAYS, GET => "Int8";
        fmi3GetUInt8 none!(_values: *mut u8, _nValues: usize) ALWAYS, GET => "UInt8";
        fmi3GetInt16 none!(_values: *mut i16, _nValues: usize) ALWAYS, GET => "Int16";
        fmi3GetUInt16 none!(_values: *mut u16, _nValues: usize) ALWAYS, GET => "UInt16";
        fmi3GetUInt32 none!(_values: *mut u32, _nValues: usize) ALWAYS, GET => "UInt32";
        fmi3GetBinary none!(_valueSizes: *const usize, _values: *const c_void, _nValues: usize) ALWAYS, GET => "Binary";
        fmi3SetFloat32 none!(_values: *const f32, _nValues: usize) CAN_SET, SET => "Float32";
        fmi3SetInt8 none!(_values: *const i8, _nValues: usize) CAN_SET, SET => "Int8";
        fmi3SetUInt8 none!(_values: *const u8, _nValues: usize) CAN_SET, SET => "UInt8";
        fmi3SetInt16 none!(_values: *const i16, _nValues: usize) CAN_SET, SET => "Int16";
        fmi3SetUInt16 none!(_values: *const u16, _nValues: usize) CAN_SET, SET => "UInt16";
        fmi3SetUInt32 none!(_values: *const u32, _nValues: usize) CAN_SET, SET => "UInt32";
        fmi3SetBinary none!(_valueSizes: *const usize, _values: *const c_void, _nValues: usize) CAN_SET, SET => "Binary";
        fmi3GetClock none!(_values: *mut Boolean) ALWAYS, CLOCKS => "Clock";
        fmi3SetClock none!(_values: *const Boolean) ALWAYS, CLOCKS => "Clock";
        fmi3GetIntervalDecimal none!(_intervals: *mut f64, _qualifiers: *mut c_int) ALWAYS, CLOCKS => "Clock";
        fmi3GetIntervalFraction none!(_counters: *mut u64, _resolutions: *mut u64, _qualifiers: *mut c_int) ALWAYS, CLOCKS => "Clock";
        fmi3GetShiftDecimal none!(_shifts: *mut f64) ALWAYS, CLOCKS => "Clock";
        fmi3GetShiftFraction none!(_counters: *mut u64, _resolutions: *mut u64) ALWAYS, CLOCKS => "Clock";
        fmi3SetIntervalDecimal none!(_intervals: *const f64) ALWAYS, CLOCKS => "Clock";
        fmi3SetIntervalFraction none!(_counters: *const u64, _resolutions: *const u64) ALWAYS, CLOCKS => "Clock";
        fmi3SetShiftDecimal none!(_shifts: *const f64) ALWAYS, CLOCKS => "Clock";
        fmi3SetShiftFraction none!(_counters: *const u64, _resolutions: *const u64) ALWAYS, CLOCKS => "Clock";
        /// Model partitions exist only for scheduled execution.
        fmi3ActivateModelPartition(_clockReference: ValueReference, _activationTime: f64) 0 => Ok(());
        /// Dependencies are only in the model description.
        fmi3GetNumberOfVariableDependencies(_valueReference: ValueReference, _nDependencies: *mut usize)
            ALWAYS, "fmi3GetVariableDependencies" => no_dependencies();
        /// Dependencies are only in the model description.
        fmi3GetVariableDependencies(
            _dependent: ValueReference, _elementIndicesOfDependent: *mut usize, _independents: *mut ValueReference,
            _elementIndicesOfIndependents: *mut usize, _dependencyKinds: *mut DependencyKind, _nDependencies: usize
        ) ALWAYS => no_dependencies();

        // SAFETY of the following rows: the host's promise, see the module
        /// An existing state is overwritten.
        fmi3GetFMUState(state: *mut FmuState) ALWAYS & !ERROR & !INTERMEDIATE => unsafe { instance.get_state(host, state) };
        fmi3SetFMUState(state: FmuState) ALWAYS & !INTERMEDIATE => unsafe { instance.set_state(host, state) };
        /// NULL is accepted.
        fmi3FreeFMUState(state: *mut FmuState) ALWAYS => unsafe { instance.free_state(host, state) };
        fmi3SerializedFMUStateSize(state: FmuState, size: *mut usize) ALWAYS =>
            unsafe { instance.serialized_size(host, state, size) };
        /// `size` must be the size that fmi3SerializedFMUStateSize returned.
        fmi3SerializeFMUState(state: FmuState, bytes: *mut u8, size: usize) ALWAYS =>
            unsafe { instance.serialize(host, state, bytes, size) };
        /// Invalid bytes change nothing.
        fmi3DeserializeFMUState(bytes: *const u8, size: usize, state: *mut FmuState) ALWAYS =>
            unsafe { instance.deserialize(host, bytes, size, state) };

        fmi3GetDirectionalDerivative sensitivity!() HAS_DERIVATIVES => values::directional_derivative;
        fmi3GetAdjointDerivative sensitivity!() HAS_DERIVATIVES => values::adjoint_derivative;
        fmi3GetOutputDerivatives(
            valueReferences: *const ValueReference as input[nValueReferences], nValueReferences: usize,
            orders: *const c_int as input[nValueReferences], values: *mut f64 as output[nValues], nValues: usize
        ) STEP | INTERMEDIATE | FAILED | TERMINATED | ERROR =>
            values::output_derivatives(instance, valueReferences, orders, values);

        fmi3EnterEventMode() STEP | EVENT | CONTINUOUS => instance.enter_event_mode();
        fmi3EnterStepMode() EVENT => instance.enter_step_mode();
        /// Does nothing: discrete values follow directly from the states and inputs, without iteration.
        fmi3EvaluateDiscreteStates() INITIALIZATION | EVENT => Ok(());
        /// Hosts iterate until all events are reported; usually there is one.
        fmi3UpdateDiscreteStates(
            discreteStatesNeedUpdate: *mut Boolean as output_value,
            terminateSimulation: *mut Boolean as output_value,
            nominalsOfContinuousStatesChanged: *mut Boolean as output_value,
            valuesOfContinuousStatesChanged: *mut Boolean as output_value,
            nextEventTimeDefined: *mut Boolean as output_value,
            nextEventTime: *mut f64 as output_value
        ) EVENT => {
            let Iteration { update, is_needed } = instance.update_discrete_states()?;
            discreteStatesNeedUpdate.write(is_needed.into());
            terminateSimulation.write(0);
            nominalsOfContinuousStatesChanged.write(0);
            valuesOfContinuousStatesChanged.write(update.states_changed.into());
            nextEventTimeDefined.write(update.next.is_some().into());
            nextEventTime.write(update.next.unwrap_or(0.0));
            Ok(())
        };
        fmi3EnterContinuousTimeMode() EVENT => instance.enter_continuous_time_mode();
        /// The flag is ignored, because snapshots are complete.
        fmi3CompletedIntegratorStep completed_step!() CONTINUOUS => Instance::completed_integrator_step;
        fmi3SetTime(time: f64) EVENT | CONTINUOUS => instance.set_time(time);
        fmi3SetContinuousStates(
            continuousStates: *const f64 as input[nContinuousStates], nContinuousStates: usize
        ) CONTINUOUS => instance.set_continuous_states(continuousStates);
        fmi3GetContinuousStateDerivatives filled!() HAS_STATES => Instance::get_derivatives;
        fmi3GetEventIndicators filled!() HAS_STATES => Instance::get_event_indicators;
        fmi3GetContinuousStates filled!() HAS_STATES => Instance::get_continuous_states;
        fmi3GetNominalsOfContinuousStates filled!() ALWAYS => Instance::get_nominals;
        fmi3GetNumberOfEventIndicators number!() ALWAYS => EVENT_INDICATORS;
        fmi3GetNumberOfContinuousStates number!() ALWAYS => STATES;
    }
}

fn no_dependencies() -> CallResult {
    Err(CallError::error(
        "dependencies of array elements are not provided; the model description contains dependencies of variables",
    ))
}

//! Getting and setting variables, and the derivatives, which this FMU does not offer.

use libc::c_int;

use super::super::calls::Call;
use super::super::instance::Instance;
use super::super::pointers::{array, room, run};
use super::super::refusal::{Answer, Refusal};
use super::super::types::{Boolean, ComponentPointer, Status, Text, ValueReference};
use super::super::values::refuse_string;

macro_rules! getters {
    ($($function:ident $call:ident $method:ident $type:ty;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            references: *const ValueReference,
            count: usize,
            values: *mut $type,
        ) -> Status {
            let body = |instance: &mut Instance| {
                // SAFETY: the host's promise, see the module
                let (references, values) = unsafe { (array("vr", references, count)?, room("value", values, count)?) };
                instance.$method(references, values)
            };
            // SAFETY: the host's promise, see the module
            unsafe { run(c, Call::$call, body) }
        }
    )+};
}

macro_rules! setters {
    ($($function:ident $call:ident $method:ident $type:ty;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            references: *const ValueReference,
            count: usize,
            values: *const $type,
        ) -> Status {
            let body = |instance: &mut Instance| {
                // SAFETY: the host's promise, see the module
                let (references, values) = unsafe { (array("vr", references, count)?, array("value", values, count)?) };
                instance.$method(references, values)
            };
            // SAFETY: the host's promise, see the module
            unsafe { run(c, Call::$call, body) }
        }
    )+};
}

getters! {
    fmi2GetReal GetReal get_real f64;
    fmi2GetInteger GetInteger get_integer c_int;
    fmi2GetBoolean GetBoolean get_boolean Boolean;
}

setters! {
    fmi2SetReal SetReal set_real f64;
    fmi2SetInteger SetInteger set_integer c_int;
    fmi2SetBoolean SetBoolean set_boolean Boolean;
}

/// Strings are legal to ask for, but there are none.
unsafe fn no_strings(references: *const ValueReference, count: usize) -> Answer {
    // SAFETY: the host's promise, see the module
    let references = unsafe { array("vr", references, count) }?;
    references.first().map_or(Ok(()), |&reference| Err(refuse_string(reference)))
}

/// fmi2GetString. There are no String variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    c: ComponentPointer,
    references: *const ValueReference,
    count: usize,
    _values: *mut Text,
) -> Status {
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetString, |_| no_strings(references, count)) }
}

/// fmi2SetString. There are no String variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    c: ComponentPointer,
    references: *const ValueReference,
    count: usize,
    _values: *const Text,
) -> Status {
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::SetString, |_| no_strings(references, count)) }
}

/// Asking for nothing is always granted; for more, only what the model description claims.
fn unclaimed(count: usize, flag: &str) -> Answer {
    if count == 0 { Ok(()) } else { Err(Refusal::error(format!("not available, the model description says {flag}"))) }
}

/// fmi2GetDirectionalDerivative. Not claimed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: ComponentPointer,
    _unknown: *const ValueReference,
    unknown_count: usize,
    _known: *const ValueReference,
    _known_count: usize,
    _known_values: *const f64,
    _unknown_values: *mut f64,
) -> Status {
    let body = |_: &mut Instance| unclaimed(unknown_count, "providesDirectionalDerivative = false");
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetDirectionalDerivative, body) }
}

/// fmi2SetRealInputDerivatives. Not claimed: inputs are constant through a step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: ComponentPointer,
    _references: *const ValueReference,
    count: usize,
    _orders: *const c_int,
    _values: *const f64,
) -> Status {
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::SetRealInputDerivatives, |_| unclaimed(count, "canInterpolateInputs = false")) }
}

/// fmi2GetRealOutputDerivatives. Not claimed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: ComponentPointer,
    _references: *const ValueReference,
    count: usize,
    _orders: *const c_int,
    _values: *mut f64,
) -> Status {
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetRealOutputDerivatives, |_| unclaimed(count, "maxOutputDerivativeOrder = 0")) }
}

//! Getting and setting variables.

use crate::fmi2::c_types::c_int;

use super::super::call_error::CallResult;
use super::super::calls::Call;
use super::super::component::run;
use super::super::host_memory::HostMemory;
use super::super::instance::Instance;
use super::super::types::{Boolean, ComponentPointer, Status, Text, ValueReference};
use super::super::values::string_error;

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
            let body = |instance: &mut Instance, host: &HostMemory| {
                // SAFETY: the host's promise, see the module
                let (references, values) =
                    unsafe { (host.input("vr", references, count)?, host.output("value", values, count)?) };
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
            let body = |instance: &mut Instance, host: &HostMemory| {
                // SAFETY: the host's promise, see the module
                let (references, values) =
                    unsafe { (host.input("vr", references, count)?, host.input("value", values, count)?) };
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

/// String variables may be read and set, but there are none.
unsafe fn no_strings(host: &HostMemory, references: *const ValueReference, count: usize) -> CallResult {
    // SAFETY: the host's promise, see the module
    let references = unsafe { host.input("vr", references, count) }?;
    references.iter().next().map_or(Ok(()), |reference| Err(string_error(reference)))
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
    unsafe { run(c, Call::GetString, |_, host| no_strings(host, references, count)) }
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
    unsafe { run(c, Call::SetString, |_, host| no_strings(host, references, count)) }
}

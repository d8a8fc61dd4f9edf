//! Getting and setting variables.

use super::*;
use crate::instance::values::string_error;

macro_rules! accesses {
    ($($function:ident $call:ident $method:ident *$way:tt $type:ty, $pass:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            references: *const ValueReference,
            count: usize,
            values: *$way $type,
        ) -> Status {
            call!(c, $call, |instance, host| {
                // SAFETY: the host's promise, see the module
                let (references, values) =
                    unsafe { (host.input("vr", references, count)?, host.$pass("value", values, count)?) };
                instance.$method(references, values)
            })
        }
    )+};
}

accesses! {
    fmi2GetReal GetReal get_real *mut f64, output;
    fmi2GetInteger GetInteger get_integer *mut c_int, output;
    fmi2GetBoolean GetBoolean get_boolean *mut Boolean, output;
    fmi2SetReal SetReal set_real *const f64, input;
    fmi2SetInteger SetInteger set_integer *const c_int, input;
    fmi2SetBoolean SetBoolean set_boolean *const Boolean, input;
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
    call!(c, GetString, |_, host| unsafe { no_strings(host, references, count) })
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
    call!(c, SetString, |_, host| unsafe { no_strings(host, references, count) })
}

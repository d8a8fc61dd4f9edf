//! Reading and setting variables.

use super::*;
use crate::instance::values::{all_or_none, string_error};

macro_rules! accesses {
    ($($function:ident $call:ident *$way:tt $type:ty, $pass:ident, |$instance:ident, $references:ident, $values:ident| $body:expr;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            references: *const ValueReference,
            count: usize,
            values: *$way $type,
        ) -> Status {
            call!(c, $call, |$instance, host| {
                // SAFETY: the host's promise, see the module
                let ($references, $values) =
                    unsafe { (host.input("vr", references, count)?, host.$pass("value", values, count)?) };
                $body
            })
        }
    )+};
}

accesses! {
    fmi2GetReal GetReal *mut f64, output, |instance, vr, values| instance.get_real(vr.iter(), values.iter());
    fmi2GetInteger GetInteger *mut c_int, output, |instance, vr, values| {
        for (vr, value) in vr.iter().zip(values.iter()) {
            value.write(instance.get_integer(vr)?);
        }
        Ok(())
    };
    fmi2GetBoolean GetBoolean *mut Boolean, output, |instance, vr, values| {
        for (vr, value) in vr.iter().zip(values.iter()) {
            value.write(instance.get_boolean(vr)?.into());
        }
        Ok(())
    };
    fmi2SetReal SetReal *const f64, input, |instance, vr, values| {
        all_or_none(vr.len(), instance.set_real(vr, values))
    };
    fmi2SetInteger SetInteger *const c_int, input, |instance, vr, values| {
        all_or_none(vr.len(), instance.set_integer(vr.iter().zip(values.iter())))
    };
    fmi2SetBoolean SetBoolean *const Boolean, input, |instance, vr, values| {
        all_or_none(vr.len(), instance.set_boolean(vr.iter().zip(values.iter().map(|value| value != 0))))
    };
}

/// Accepts no references, because there are no String variables.
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

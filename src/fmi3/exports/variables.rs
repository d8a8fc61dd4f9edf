//! Reading and setting variables of the types that the FMU has.

use super::*;
use crate::instance::values::all_or_none;

/// Outcome of a call. If a call that sets several values fails, the message adds that none of them was set. The outcome
/// of a call that reads values is unchanged. The first argument is the direction of the array `values`: `output` if the
/// call reads variables, `input` if the call sets them.
macro_rules! outcome {
    (output, $count:expr, $outcome:expr) => {
        $outcome
    };
    (input, $count:expr, $outcome:expr) => {
        all_or_none($count, $outcome)
    };
}

macro_rules! accesses {
    ($($function:ident $call:ident $method:ident *$way:tt $type:ty, $pass:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            references: *const ValueReference,
            count: usize,
            values: *$way $type,
            value_count: usize,
        ) -> Status {
            call!(c, $call, |instance, host| {
                // SAFETY: the host's promise, see the module
                let (references, values) = unsafe {
                    (
                        host.input("valueReferences", references, count)?,
                        host.$pass("values", values, value_count)?,
                    )
                };
                outcome!($pass, count, values::$method(instance, references, values))
            })
        }
    )+};
}

accesses! {
    fmi3GetFloat64 GetFloat64 get_float64 *mut f64, output;
    fmi3GetInt32 GetInt32 get_int32 *mut i32, output;
    fmi3GetInt64 GetInt64 get_int64 *mut i64, output;
    fmi3GetUInt64 GetUInt64 get_uint64 *mut u64, output;
    fmi3GetBoolean GetBoolean get_boolean *mut Boolean, output;
    fmi3SetFloat64 SetFloat64 set_float64 *const f64, input;
    fmi3SetInt32 SetInt32 set_int32 *const i32, input;
    fmi3SetInt64 SetInt64 set_int64 *const i64, input;
    fmi3SetUInt64 SetUInt64 set_uint64 *const u64, input;
    fmi3SetBoolean SetBoolean set_boolean *const Boolean, input;
}

/// fmi3GetString. The returned text is never freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetString(
    c: ComponentPointer,
    references: *const ValueReference,
    count: usize,
    values: *mut Text,
    value_count: usize,
) -> Status {
    call!(c, GetString, |instance, host| {
        // SAFETY: the host's promise, see the module
        let (references, room) =
            unsafe { (host.input("valueReferences", references, count)?, host.output("values", values, value_count)?) };
        values::check_count(references.len(), room.len())?;
        for (reference, value) in references.iter().zip(room.iter()) {
            value.write(values::event_text(instance, reference)?.as_ptr());
        }
        Ok(())
    })
}

/// fmi3SetString. The only String variable is an output.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetString(
    c: ComponentPointer,
    references: *const ValueReference,
    count: usize,
    _values: *const Text,
    _value_count: usize,
) -> Status {
    call!(c, SetString, |_, host| {
        // SAFETY: the host's promise, see the module
        values::none_of(unsafe { host.input("valueReferences", references, count)? }, "settable String")
    })
}

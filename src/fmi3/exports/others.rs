//! Reading and setting variables of types that the FMU does not have.

use super::*;

macro_rules! none {
    ($($function:ident $call:ident $name:literal *$way:tt $type:ty;)+) => {$(
        #[doc = concat!(stringify!($function), ": there are no such variables.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            references: *const ValueReference,
            count: usize,
            _values: *$way $type,
            _value_count: usize,
        ) -> Status {
            call!(c, $call, |_, host| {
                // SAFETY: the host's promise, see the module
                values::none_of(unsafe { host.input("valueReferences", references, count)? }, $name)
            })
        }
    )+};
}

none! {
    fmi3GetFloat32 GetOther "Float32" *mut f32;
    fmi3GetInt8 GetOther "Int8" *mut i8;
    fmi3GetUInt8 GetOther "UInt8" *mut u8;
    fmi3GetInt16 GetOther "Int16" *mut i16;
    fmi3GetUInt16 GetOther "UInt16" *mut u16;
    fmi3GetUInt32 GetOther "UInt32" *mut u32;
    fmi3SetFloat32 SetOther "Float32" *const f32;
    fmi3SetInt8 SetOther "Int8" *const i8;
    fmi3SetUInt8 SetOther "UInt8" *const u8;
    fmi3SetInt16 SetOther "Int16" *const i16;
    fmi3SetUInt16 SetOther "UInt16" *const u16;
    fmi3SetUInt32 SetOther "UInt32" *const u32;
}

macro_rules! no_binary {
    ($($function:ident $call:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ": there are no binary variables.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            references: *const ValueReference,
            count: usize,
            _sizes: *const usize,
            _values: *const c_void,
            _value_count: usize,
        ) -> Status {
            call!(c, $call, |_, host| {
                // SAFETY: the host's promise, see the module
                values::none_of(unsafe { host.input("valueReferences", references, count)? }, "Binary")
            })
        }
    )+};
}

no_binary! {
    fmi3GetBinary GetOther;
    fmi3SetBinary SetOther;
}

/// fmi3GetNumberOfVariableDependencies. Dependencies are only in the model description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfVariableDependencies(
    c: ComponentPointer,
    _reference: ValueReference,
    _count: *mut usize,
) -> Status {
    call!(c, GetVariableDependencies, |_, _| Err(no_dependencies()))
}

/// fmi3GetVariableDependencies. Dependencies are only in the model description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetVariableDependencies(
    c: ComponentPointer,
    _dependent: ValueReference,
    _elements: *mut usize,
    _independents: *mut ValueReference,
    _independent_elements: *mut usize,
    _kinds: *mut DependencyKind,
    _count: usize,
) -> Status {
    call!(c, GetVariableDependencies, |_, _| Err(no_dependencies()))
}

fn no_dependencies() -> CallError {
    CallError::error(
        "dependencies of array elements are not provided; the model description contains dependencies of variables",
    )
}

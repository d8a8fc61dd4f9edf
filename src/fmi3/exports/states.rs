//! FMU states, which the host stores as pointers to snapshots or as bytes.

use super::*;

/// fmi3GetFMUState. An existing state is overwritten.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(c: ComponentPointer, state: *mut FmuState) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, GetFmuState, |instance, host| unsafe { instance.get_state(host, state) })
}

/// fmi3SetFMUState.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(c: ComponentPointer, state: FmuState) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, SetFmuState, |instance, host| unsafe { instance.set_state(host, state) })
}

/// fmi3FreeFMUState. NULL is accepted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(c: ComponentPointer, state: *mut FmuState) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, FreeFmuState, |instance, host| unsafe { instance.free_state(host, state) })
}

/// fmi3SerializedFMUStateSize.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(c: ComponentPointer, state: FmuState, size: *mut usize) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, SerializedFmuStateSize, |instance, host| unsafe { instance.serialized_size(host, state, size) })
}

/// fmi3SerializeFMUState. `size` must be the size that fmi3SerializedFMUStateSize returned.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    c: ComponentPointer,
    state: FmuState,
    bytes: *mut u8,
    size: usize,
) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, SerializeFmuState, |instance, host| unsafe { instance.serialize(host, state, bytes, size) })
}

/// fmi3DeserializeFMUState. Invalid bytes change nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    c: ComponentPointer,
    bytes: *const u8,
    size: usize,
    state: *mut FmuState,
) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, DeserializeFmuState, |instance, host| unsafe { instance.deserialize(host, bytes, size, state) })
}

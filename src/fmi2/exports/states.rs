//! FMU states, which the host stores as pointers to snapshots or as bytes.

use super::*;

/// fmi2GetFMUstate. An existing state is overwritten.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: ComponentPointer, state: *mut FmuState) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, GetFmuState, |instance, host| unsafe { instance.get_state(host, state) })
}

/// fmi2SetFMUstate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: ComponentPointer, state: FmuState) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, SetFmuState, |instance, host| unsafe { instance.set_state(host, state) })
}

/// fmi2FreeFMUstate. NULL is accepted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: ComponentPointer, state: *mut FmuState) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, FreeFmuState, |instance, host| unsafe { instance.free_state(host, state) })
}

/// fmi2SerializedFMUstateSize.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(c: ComponentPointer, state: FmuState, size: *mut usize) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, SerializedFmuStateSize, |instance, host| unsafe { instance.serialized_size(host, state, size) })
}

/// fmi2SerializeFMUstate. `size` must be the size that fmi2SerializedFMUstateSize returned.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: ComponentPointer,
    state: FmuState,
    bytes: *mut c_char,
    size: usize,
) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, SerializeFmuState, |instance, host| unsafe { instance.serialize(host, state, bytes.cast(), size) })
}

/// fmi2DeSerializeFMUstate. Invalid bytes change nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: ComponentPointer,
    bytes: *const c_char,
    size: usize,
    state: *mut FmuState,
) -> Status {
    // SAFETY: the host's promise, see the module
    call!(c, DeSerializeFmuState, |instance, host| unsafe { instance.deserialize(host, bytes.cast(), size, state) })
}

//! FMU states: the host keeps them as pointers to snapshots, or as bytes.

use std::cell::Cell;
use std::ptr;

use super::*;
use crate::instance::Snapshot;

/// The snapshot behind `state`, for as long as the call lasts.
unsafe fn snapshot(_call: &HostMemory, state: FmuState) -> CallResult<&Snapshot> {
    let state = state.cast::<Snapshot>();
    if state.is_null() || !state.is_aligned() {
        return Err(CallError::error("FMUstate is NULL or not a state of this FMU"));
    }
    // SAFETY: a state that is not NULL comes from `store`, by the host's promise
    Ok(unsafe { &*state })
}

/// Stores `snapshot` in `state`; allocates a state if there is none yet.
unsafe fn store(state: &Cell<FmuState>, snapshot: Snapshot) -> CallResult {
    let old = state.get().cast::<Snapshot>();
    if old.is_null() {
        state.set(Box::into_raw(Box::new(snapshot)).cast());
    } else if old.is_aligned() {
        // SAFETY: a state that is not NULL comes from the branch above, by the host's promise
        unsafe { *old = snapshot };
    } else {
        return Err(CallError::error("*FMUstate is neither NULL nor a state of this FMU"));
    }
    Ok(())
}

/// fmi2GetFMUstate. An existing state is overwritten.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: ComponentPointer, state: *mut FmuState) -> Status {
    call!(c, GetFmuState, |instance, host| {
        // SAFETY: the host's promise, see the module
        unsafe { store(host.value("FMUstate", state)?, instance.now.clone()) }
    })
}

/// fmi2SetFMUstate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: ComponentPointer, state: FmuState) -> Status {
    call!(c, SetFmuState, |instance, host| {
        // SAFETY: the host's promise, see the module
        let snapshot = unsafe { snapshot(host, state) }?;
        instance.restore(snapshot)
    })
}

/// fmi2FreeFMUstate. NULL is accepted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: ComponentPointer, state: *mut FmuState) -> Status {
    call!(c, FreeFmuState, |_, host| {
        if state.is_null() {
            return Ok(());
        }
        // SAFETY: the host's promise: `state` points to an initialised pointer
        let state = unsafe { host.value("FMUstate", state) }?;
        let old = state.replace(ptr::null_mut()).cast::<Snapshot>();
        if !old.is_null() && old.is_aligned() {
            // SAFETY: it came from `Box::into_raw` in `store`, and the host's pointer to it is cleared
            drop(unsafe { Box::from_raw(old) });
        }
        Ok(())
    })
}

/// fmi2SerializedFMUstateSize.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(c: ComponentPointer, state: FmuState, size: *mut usize) -> Status {
    call!(c, SerializedFmuStateSize, |_, host| {
        // SAFETY: the host's promise, see the module
        let (snapshot, size) = unsafe { (snapshot(host, state)?, host.output_value("size", size)?) };
        size.write(snapshot.to_bytes().map_err(CallError::error)?.len());
        Ok(())
    })
}

/// fmi2SerializeFMUstate. `size` must be the size that fmi2SerializedFMUstateSize returned.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: ComponentPointer,
    state: FmuState,
    bytes: *mut c_char,
    size: usize,
) -> Status {
    call!(c, SerializeFmuState, |_, host| {
        // SAFETY: the host's promise, see the module
        let (snapshot, target) =
            unsafe { (snapshot(host, state)?, host.output("serializedState", bytes.cast::<u8>(), size)?) };
        let bytes = snapshot.to_bytes().map_err(CallError::error)?;
        if bytes.len() != size {
            return Err(CallError::error(format!("the state takes {} bytes, not {size}", bytes.len())));
        }
        for (byte, target) in bytes.into_iter().zip(target.iter()) {
            target.write(byte);
        }
        Ok(())
    })
}

/// fmi2DeSerializeFMUstate. Invalid bytes change nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: ComponentPointer,
    bytes: *const c_char,
    size: usize,
    state: *mut FmuState,
) -> Status {
    call!(c, DeSerializeFmuState, |instance, host| {
        // SAFETY: the host's promise, see the module
        let bytes = unsafe { host.bytes("serializedState", bytes.cast::<u8>(), size) }?;
        let snapshot = Snapshot::from_bytes(bytes, &instance.cache).map_err(CallError::error)?;
        // SAFETY: the host's promise, see the module
        unsafe { store(host.value("FMUstate", state)?, snapshot) }
    })
}

//! FMU states: kept by the host as pointers to owned snapshots, or as bytes.

use std::ptr;

use libc::c_char;

use super::super::calls::Call;
use super::super::instance::Instance;
use super::super::pointers::{array, place, room, run};
use super::super::refusal::{Answer, Refusal};
use super::super::snapshot::Snapshot;
use super::super::types::{ComponentPointer, FmuState, Status};

/// The snapshot behind `state`.
unsafe fn snapshot<'a>(state: FmuState) -> Answer<&'a Snapshot> {
    let state = state.cast::<Snapshot>();
    if state.is_null() || !state.is_aligned() {
        return Err(Refusal::error("FMUstate is NULL or none of this FMU's states"));
    }
    // SAFETY: a state that is not NULL comes from `keep`, by the host's promise
    Ok(unsafe { &*state })
}

/// Stores `snapshot` in the state behind `state`, which is made if there is none.
unsafe fn keep(state: *mut FmuState, snapshot: Snapshot) -> Answer {
    // SAFETY: the host's promise: `state` points to an initialised pointer
    let held = unsafe { place("FMUstate", state)?.assume_init_mut() };
    let old = held.cast::<Snapshot>();
    if old.is_null() {
        *held = Box::into_raw(Box::new(snapshot)).cast();
    } else if old.is_aligned() {
        // SAFETY: a state that is not NULL comes from the branch above, by the host's promise
        unsafe { *old = snapshot };
    } else {
        return Err(Refusal::error("*FMUstate is neither NULL nor one of this FMU's states"));
    }
    Ok(())
}

/// fmi2GetFMUstate. A state that exists already is overwritten.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: ComponentPointer, state: *mut FmuState) -> Status {
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetFmuState, |instance| keep(state, instance.now.clone())) }
}

/// fmi2SetFMUstate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: ComponentPointer, state: FmuState) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: the host's promise, see the module
        let snapshot = unsafe { snapshot(state) }?;
        if snapshot.kind != instance.now.kind {
            return Err(Refusal::error(format!(
                "the state is of an instance made for {:?}, this one was made for {:?}",
                snapshot.kind, instance.now.kind
            )));
        }
        instance.now = snapshot.clone();
        Ok(())
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::SetFmuState, body) }
}

/// fmi2FreeFMUstate. Nothing to free is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: ComponentPointer, state: *mut FmuState) -> Status {
    let body = |_: &mut Instance| {
        if state.is_null() {
            return Ok(());
        }
        // SAFETY: the host's promise: `state` points to an initialised pointer
        let held = unsafe { place("FMUstate", state)?.assume_init_mut() };
        // SAFETY: the host's promise, see the module
        if !held.is_null() && unsafe { snapshot(*held) }.is_ok() {
            // SAFETY: it came from `Box::into_raw` in `keep`, and the host's pointer to it is cleared here
            drop(unsafe { Box::from_raw(held.cast::<Snapshot>()) });
        }
        *held = ptr::null_mut();
        Ok(())
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::FreeFmuState, body) }
}

/// fmi2SerializedFMUstateSize.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(c: ComponentPointer, state: FmuState, size: *mut usize) -> Status {
    let body = |_: &mut Instance| {
        // SAFETY: the host's promise, see the module
        let (snapshot, size) = unsafe { (snapshot(state)?, place("size", size)?) };
        size.write(snapshot.to_bytes().map_err(Refusal::error)?.len());
        Ok(())
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::SerializedFmuStateSize, body) }
}

/// fmi2SerializeFMUstate. `size` must be what fmi2SerializedFMUstateSize told.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: ComponentPointer,
    state: FmuState,
    bytes: *mut c_char,
    size: usize,
) -> Status {
    let body = |_: &mut Instance| {
        // SAFETY: the host's promise, see the module
        let (snapshot, room) = unsafe { (snapshot(state)?, room("serializedState", bytes.cast::<u8>(), size)?) };
        let bytes = snapshot.to_bytes().map_err(Refusal::error)?;
        if bytes.len() != size {
            return Err(Refusal::error(format!("the state takes {} bytes, not {size}", bytes.len())));
        }
        for (byte, place) in bytes.into_iter().zip(room) {
            place.write(byte);
        }
        Ok(())
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::SerializeFmuState, body) }
}

/// fmi2DeSerializeFMUstate. Bytes that cannot be used leave everything as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: ComponentPointer,
    bytes: *const c_char,
    size: usize,
    state: *mut FmuState,
) -> Status {
    let body = |_: &mut Instance| {
        // SAFETY: the host's promise, see the module
        let bytes = unsafe { array("serializedState", bytes.cast::<u8>(), size) }?;
        let snapshot = Snapshot::from_bytes(bytes).map_err(Refusal::error)?;
        // SAFETY: the host's promise, see the module
        unsafe { keep(state, snapshot) }
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::DeSerializeFmuState, body) }
}

//! Data that the host stores: states, as pointers to snapshots or as bytes, and the categories of its log.

use std::cell::Cell;
use std::ptr;

use super::{CallError, CallResult, FmuState, HostMemory, InputArray, Instance, Snapshot, Text};

/// Returns the snapshot behind `state`, for as long as the call lasts.
unsafe fn snapshot(_call: &HostMemory, state: FmuState) -> CallResult<&Snapshot> {
    let state = state.cast::<Snapshot>();
    if state.is_null() || !state.is_aligned() {
        return Err(CallError::error("FMUstate is NULL or not a state of this FMU"));
    }
    // SAFETY: a state that is not NULL comes from `store`, by the host's promise
    Ok(unsafe { &*state })
}

/// Stores `snapshot` in `state`, and allocates a state if necessary.
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

/// # Safety
/// Every pointer that is not NULL points to what FMI specifies for as long as the call lasts.
#[allow(clippy::missing_safety_doc)]
impl Instance {
    /// Stores the present state. An existing state is overwritten.
    pub unsafe fn get_state(&self, host: &HostMemory, state: *mut FmuState) -> CallResult {
        // SAFETY: the caller's promise
        unsafe { store(host.value("FMUstate", state)?, self.now.clone()) }
    }

    /// Restores a state.
    pub unsafe fn set_state(&mut self, host: &HostMemory, state: FmuState) -> CallResult {
        // SAFETY: the caller's promise
        self.restore(unsafe { snapshot(host, state) }?)
    }

    /// Frees a state. NULL is accepted.
    pub unsafe fn free_state(&self, host: &HostMemory, state: *mut FmuState) -> CallResult {
        if state.is_null() {
            return Ok(());
        }
        // SAFETY: the caller's promise: `state` points to an initialised pointer
        let state = unsafe { host.value("FMUstate", state)? };
        let old = state.replace(ptr::null_mut()).cast::<Snapshot>();
        if !old.is_null() && old.is_aligned() {
            // SAFETY: it comes from `Box::into_raw` in `store`, and the host's pointer to it is cleared
            drop(unsafe { Box::from_raw(old) });
        }
        Ok(())
    }

    /// Writes the size of a serialised state in bytes.
    pub unsafe fn serialized_size(&self, host: &HostMemory, state: FmuState, size: *mut usize) -> CallResult {
        // SAFETY: the caller's promise
        let (snapshot, size) = unsafe { (snapshot(host, state)?, host.output_value("size", size)?) };
        size.write(snapshot.to_bytes().map_err(CallError::error)?.len());
        Ok(())
    }

    /// Writes a state as bytes. `size` must be the size from [`Self::serialized_size`].
    pub unsafe fn serialize(&self, host: &HostMemory, state: FmuState, bytes: *mut u8, size: usize) -> CallResult {
        // SAFETY: the caller's promise
        let (snapshot, target) = unsafe { (snapshot(host, state)?, host.output("serializedState", bytes, size)?) };
        let bytes = snapshot.to_bytes().map_err(CallError::error)?;
        if bytes.len() != size {
            return Err(CallError::error(format!("the state needs {} bytes, not {size}", bytes.len())));
        }
        for (byte, target) in bytes.into_iter().zip(target.iter()) {
            target.write(byte);
        }
        Ok(())
    }

    /// Stores the state that `bytes` contain in `state`. Invalid bytes change nothing.
    pub unsafe fn deserialize(
        &self,
        host: &HostMemory,
        bytes: *const u8,
        size: usize,
        state: *mut FmuState,
    ) -> CallResult {
        // SAFETY: the caller's promise
        let bytes = unsafe { host.bytes("serializedState", bytes, size) }?;
        let snapshot = Snapshot::from_bytes(bytes, &self.cache).map_err(CallError::error)?;
        // SAFETY: the caller's promise
        unsafe { store(host.value("FMUstate", state)?, snapshot) }
    }

    /// Sets which messages are logged. An empty list of categories means all.
    pub unsafe fn configure_log(&mut self, host: &HostMemory, is_on: bool, categories: InputArray<Text>) -> CallResult {
        // SAFETY: the caller's promise
        let names: Vec<_> = categories.iter().map(|text| unsafe { host.string(text) }.unwrap_or(c"NULL")).collect();
        let unknown = self.log.configure(is_on, names.into_iter());
        if unknown.is_empty() {
            Ok(())
        } else {
            Err(CallError::warning(format!("unknown log categories: {unknown:?}")))
        }
    }
}

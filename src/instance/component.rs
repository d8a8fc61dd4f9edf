//! Component: the memory behind a host's pointer to an instance. Every call runs in the same frame: one call at a time,
//! in a legal state, and without panics.

use std::cell::UnsafeCell;
use std::ptr;
use std::sync::atomic::{AtomicBool, Ordering};

use super::{Call, CallError, CallResult, ComponentPointer, HostMemory, Instance, Status, panic_guard};

/// Memory behind a host's pointer to an instance.
pub struct Component {
    /// True during a call. A second call, from the logger or from another thread, is then refused.
    busy: AtomicBool,
    instance: UnsafeCell<Instance>,
}

/// Guard of a running call: clears `busy` when it is dropped.
struct Release<'a>(&'a AtomicBool);

impl Drop for Release<'_> {
    fn drop(&mut self) {
        self.0.store(false, Ordering::Release);
    }
}

impl Component {
    /// Passes ownership of `instance` to the host.
    pub fn into_pointer(instance: Instance) -> ComponentPointer {
        Box::into_raw(Box::new(Self { busy: AtomicBool::new(false), instance: UnsafeCell::new(instance) })).cast()
    }

    /// Starts a call. Returns `None` if another call is running.
    fn enter(&self) -> Option<Release<'_>> {
        (!self.busy.swap(true, Ordering::Acquire)).then(|| Release(&self.busy))
    }
}

/// Returns a pointer to the instance that `make` creates; NULL if it creates none.
pub fn create(make: impl FnOnce(&HostMemory) -> Option<Instance>) -> ComponentPointer {
    let instance = panic_guard::catch(|| HostMemory::during_call(make));
    instance.ok().flatten().map_or(ptr::null_mut(), Component::into_pointer)
}

/// Runs `body` for `call` on the instance behind `component` if the instance's state allows the call. Logs an error and
/// returns the status. A NULL pointer, or a call during another call, gives an error without a message.
///
/// # Safety
/// `component` is NULL or comes from [`Component::into_pointer`] and was not freed.
pub unsafe fn run(
    component: ComponentPointer,
    call: &Call,
    body: impl FnOnce(&mut Instance, &HostMemory) -> CallResult,
) -> Status {
    if component.is_null() || !component.cast::<Component>().is_aligned() {
        return Status::Error;
    }
    // SAFETY: not NULL, so it comes from `Component::into_pointer` by the caller's promise; shared access only
    let component = unsafe { &*component.cast::<Component>() };
    let Some(_release) = component.enter() else { return Status::Error };
    // SAFETY: `busy` was clear and is set until `_release` is dropped, so no other reference to the instance exists
    let instance = unsafe { &mut *component.instance.get() };
    let outcome = panic_guard::catch(|| {
        if instance.interface.version != call.version {
            return Err(other_interface(instance.interface.version));
        }
        call.check(instance.now.phase)?;
        HostMemory::during_call(|host| body(instance, host))
    });
    match outcome {
        Ok(Ok(())) => Status::Ok,
        failed => report(instance, call, failed),
    }
}

/// Logs the error of a call and returns its status.
#[cold]
fn report(instance: &mut Instance, call: &Call, outcome: Result<CallResult, String>) -> Status {
    let error = match outcome {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(error)) => error,
        Err(panic) => {
            instance.fail();
            let interface = instance.interface;
            CallError::error(format!(
                "internal error, please report: {panic}; continue with {} or {}",
                interface.reset, interface.set_state
            ))
        }
    };
    instance.log.status(error.status, &format!("{}: {}", call.name(), error.message));
    error.status
}

#[cold]
fn other_interface(version: u32) -> CallError {
    CallError::error(format!(
        "the instance was created with FMI {version}.0, so only functions of FMI {version}.0 may use it"
    ))
}

/// Frees the instance behind `component`. Does nothing while a call is running.
///
/// # Safety
/// `component` is NULL or comes from [`Component::into_pointer`] and was not freed. It is not used afterwards.
pub unsafe fn free(component: ComponentPointer) {
    if component.is_null() || !component.cast::<Component>().is_aligned() {
        return;
    }
    let component = component.cast::<Component>();
    // SAFETY: not NULL, so it comes from `Component::into_pointer` by the caller's promise; an instance whose call is
    // still running is never freed
    if unsafe { &*component }.enter().map(std::mem::forget).is_some() {
        // SAFETY: it comes from `Box::into_raw`, no call is running, and none follows
        let _ = panic_guard::catch(|| drop(unsafe { Box::from_raw(component) }));
    }
}

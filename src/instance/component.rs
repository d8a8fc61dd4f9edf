//! What a host's pointer to an instance points to, and the frame around every call: one call at a time, in a legal state, without panics.

use std::cell::UnsafeCell;
use std::sync::atomic::{AtomicBool, Ordering};

use super::phase::LegalCall;
use super::{CallError, CallResult, ComponentPointer, HostMemory, Instance, Status, panic_guard};

/// What a host's pointer points to.
pub struct Component {
    /// Set during a call. A second call, from the logger or from another thread, is then refused.
    busy: AtomicBool,
    instance: UnsafeCell<Instance>,
}

struct Release<'a>(&'a AtomicBool);

impl Drop for Release<'_> {
    fn drop(&mut self) {
        self.0.store(false, Ordering::Release);
    }
}

impl Component {
    /// Gives `instance` to the host.
    pub fn into_pointer(instance: Instance) -> ComponentPointer {
        Box::into_raw(Box::new(Self { busy: AtomicBool::new(false), instance: UnsafeCell::new(instance) })).cast()
    }

    fn enter(&self) -> Option<Release<'_>> {
        (!self.busy.swap(true, Ordering::Acquire)).then(|| Release(&self.busy))
    }
}

/// Carries out `call` on the instance behind `component` if its state allows it; logs an error and returns the status.
///
/// # Safety
/// `component` is NULL or comes from [`Component::into_pointer`] and was not freed.
pub unsafe fn run<C: LegalCall>(
    component: ComponentPointer,
    call: C,
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
        if instance.interface.version != C::INTERFACE.version {
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

/// Logs why a call failed and returns its status.
#[cold]
fn report(instance: &mut Instance, call: impl LegalCall, outcome: Result<CallResult, String>) -> Status {
    let error = match outcome {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(error)) => error,
        Err(panic) => {
            instance.fail();
            let interface = instance.interface;
            CallError::error(format!(
                "internal error, please report: {panic}; only {} or {} help now",
                interface.reset, interface.set_state
            ))
        }
    };
    instance.log.status(error.status, &format!("{}: {}", call.name(), error.message));
    error.status
}

#[cold]
fn other_interface(version: u32) -> CallError {
    CallError::error(format!("the instance was made by a function of FMI {version}.0, and has no others"))
}

/// Frees the instance behind `component`.
///
/// # Safety
/// As `run`, and `component` is not used again.
pub unsafe fn free(component: ComponentPointer) {
    if component.is_null() || !component.cast::<Component>().is_aligned() {
        return;
    }
    let component = component.cast::<Component>();
    // SAFETY: as in `run`; an instance whose call still runs is never freed
    if unsafe { &*component }.enter().map(std::mem::forget).is_some() {
        // SAFETY: it came from `Box::into_raw`, no call is running, and none follows
        let _ = panic_guard::catch(|| drop(unsafe { Box::from_raw(component) }));
    }
}

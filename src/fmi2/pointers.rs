//! From foreign pointers to Rust values, each checked for what can be checked: NULL, alignment, length.
//!
//! That a pointer that is not NULL points to what FMI says, for as long as the call lasts, is the host's promise.

use std::cell::UnsafeCell;
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::slice;
use std::sync::atomic::{AtomicBool, Ordering};

use super::calls::Call;
use super::instance::Instance;
use super::quiet;
use super::refusal::{Answer, Refusal};
use super::types::{ComponentPointer, Status, Text};

/// What fmi2Component points to.
pub struct Component {
    /// Set while a call runs: a call from inside the logger, or from a second thread, finds it set and is refused.
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

/// Carries out `call` on the instance behind `component`: legal? carried out? logged, and told as a status.
///
/// # Safety
/// `component` is NULL or comes from fmi2Instantiate and was not freed.
pub unsafe fn run(component: ComponentPointer, call: Call, body: impl FnOnce(&mut Instance) -> Answer) -> Status {
    if component.is_null() || !component.cast::<Component>().is_aligned() {
        return Status::Error;
    }
    // SAFETY: not NULL, so it comes from `Component::into_pointer` by the caller's promise; shared access only
    let component = unsafe { &*component.cast::<Component>() };
    let Some(_release) = component.enter() else { return Status::Error };
    // SAFETY: `busy` was clear and is set until `_release` is dropped, so no other reference to the instance exists
    let instance = unsafe { &mut *component.instance.get() };
    let outcome = quiet::catch(|| {
        call.check(instance.now.phase)?;
        body(instance)
    });
    match outcome {
        Ok(Ok(())) => Status::Ok,
        failed => refuse(instance, call, failed),
    }
}

#[cold]
fn refuse(instance: &mut Instance, call: Call, outcome: Result<Answer, String>) -> Status {
    let refusal = match outcome {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(refusal)) => refusal,
        Err(panic) => {
            instance.fail();
            Refusal::error(format!(
                "internal error, please report: {panic}; only fmi2Reset or fmi2SetFMUstate help now"
            ))
        }
    };
    instance.log.status(refusal.status, &format!("{}: {}", call.name(), refusal.message));
    refusal.status
}

/// Ends the instance behind `component`.
///
/// # Safety
/// As `run`, and `component` is not used again.
pub unsafe fn free(component: ComponentPointer) {
    if component.is_null() || !component.cast::<Component>().is_aligned() {
        return;
    }
    let component = component.cast::<Component>();
    // SAFETY: as in `run`; a call still running keeps its instance, which then is never freed
    if unsafe { &*component }.enter().map(std::mem::forget).is_some() {
        // SAFETY: it came from `Box::into_raw`, no call is running, and none comes after
        let _ = quiet::catch(|| drop(unsafe { Box::from_raw(component) }));
    }
}

fn check_array<T>(name: &str, pointer: *const T, count: usize) -> Answer {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(Refusal::error(format!("{name} is NULL or misaligned, but {count} elements are announced")));
    }
    if count > isize::MAX as usize / size_of::<T>().max(1) {
        return Err(Refusal::error(format!("{name}: {count} elements are more than memory can hold")));
    }
    Ok(())
}

/// An array to read; `pointer` may be NULL when `count` is 0.
///
/// # Safety
/// If not NULL, `pointer` points to `count` values that nobody changes for `'a`.
pub unsafe fn array<'a, T>(name: &str, pointer: *const T, count: usize) -> Answer<&'a [T]> {
    if count == 0 {
        return Ok(&[]);
    }
    check_array(name, pointer, count)?;
    // SAFETY: not NULL, aligned, not too long; the rest is the caller's promise
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// An array to write; `pointer` may be NULL when `count` is 0.
///
/// # Safety
/// If not NULL, `pointer` points to room for `count` values that nobody else touches for `'a`.
pub unsafe fn room<'a, T>(name: &str, pointer: *mut T, count: usize) -> Answer<&'a mut [MaybeUninit<T>]> {
    if count == 0 {
        return Ok(&mut []);
    }
    check_array(name, pointer, count)?;
    // SAFETY: not NULL, aligned, not too long; the rest is the caller's promise; contents may be uninitialised
    Ok(unsafe { slice::from_raw_parts_mut(pointer.cast(), count) })
}

/// Room for one value.
///
/// # Safety
/// As `room` for one value.
pub unsafe fn place<'a, T>(name: &str, pointer: *mut T) -> Answer<&'a mut MaybeUninit<T>> {
    // SAFETY: the caller's promise
    let [place] = unsafe { room(name, pointer, 1) }? else { return Err(Refusal::error(name)) };
    Ok(place)
}

/// A string; none if NULL.
///
/// # Safety
/// If not NULL, `text` ends with NUL and does not change for `'a`.
pub unsafe fn string<'a>(text: Text) -> Option<&'a CStr> {
    // SAFETY: not NULL; the rest is the caller's promise
    (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) })
}

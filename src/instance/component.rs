//! Component: the memory behind a host's pointer to an instance. Every call runs in the same frame: one call at a time,
//! in a legal state, without panics, and with masked floating-point traps of the host. A panic inside a call becomes a
//! message for the host's log instead of text on stderr.
//!
//! Macros define the C functions of both versions of FMI, which are such calls, from their tables.

use std::any::Any;
use std::cell::{Cell, UnsafeCell};
use std::panic::{self, AssertUnwindSafe};
use std::ptr;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use super::float_traps::MaskedTraps;
use super::{Call, CallError, CallResult, ComponentPointer, HostMemory, Instance, Status};

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
    let instance = catch(|| make(&HostMemory::of_call()));
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
    let outcome = catch(|| {
        if instance.interface.version != call.version {
            return Err(other_interface(instance.interface.version));
        }
        call.check(instance.now.phase)?;
        body(instance, &HostMemory::of_call())
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
        let _ = catch(|| drop(unsafe { Box::from_raw(component) }));
    }
}

thread_local! {
    /// True while this thread is inside a call of this library.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
}

/// Runs `body` with masked floating-point traps. Returns the message of a panic in it, and prints nothing.
pub fn catch<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    // the hook belongs to this library's copy of std; panics elsewhere in the process keep their hook
    HOOK.call_once(|| {
        let previous = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !INSIDE.get() {
                previous(info);
            }
        }));
    });
    let _masked = MaskedTraps::new();
    let outer = INSIDE.replace(true);
    let outcome = panic::catch_unwind(AssertUnwindSafe(body));
    INSIDE.set(outer);
    outcome.map_err(|panic| text(panic.as_ref()).to_owned())
}

fn text(panic: &(dyn Any + Send)) -> &str {
    let owned = panic.downcast_ref::<String>().map(String::as_str);
    owned.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message")
}

/// Defines the C functions that are called on an instance, and the list `CALLS` of their calls. Before the rows are the
/// version of FMI, the names of the instance and of the host's memory in the rows, and calls of functions written by
/// hand. Each group of rows begins with the condition of the builds that have it. A row is
///
/// `function(arguments) states, "name in messages" => result;`
///
/// An argument with `as check[count]` is what the method `check` of [`HostMemory`](super::HostMemory) returns for the
/// pointer. Without a name in messages, messages name the function. In a row `function shape!(…) …`, the macro `shape`
/// gives the signature: it passes the row on to `export`.
macro_rules! calls {
    ($version:literal |$instance:ident, $host:ident| [$($other:expr),*] $($builds:tt {$(
        $(#[$doc:meta])* $function:ident $($shape:ident !)? ($($arguments:tt)*) $phases:expr $(, $name:expr)? => $result:expr;
    )+})+) => {
        /// All calls.
        pub const CALLS: &[$crate::instance::Call] = &[$($other,)* $($(
            #[cfg $builds]
            $crate::instance::Call { version: $version, names: &[stringify!($function) $(, $name)?], phases: $phases },
        )+)+];

        $($(
            #[cfg $builds]
            $crate::instance::export! {
                [$($shape)?] ($($arguments)*) (
                    #[doc = concat!(stringify!($function), ".")]
                    $(#[$doc])*
                    $function
                    $crate::instance::Call {
                        version: $version,
                        names: &[stringify!($function) $(, $name)?],
                        phases: $phases,
                    }
                )
                |$instance, $host| $result
            }
        )+)+
    };
}

/// Defines a C function, which carries out a call.
macro_rules! export {
    (
        [] ($($argument:ident: $type:ty $(as $check:ident $([$count:ident])?)?),*)
        ($(#[$attribute:meta])* $function:ident $call:expr) |$instance:ident, $host:ident| $result:expr
    ) => {
        $(#[$attribute])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: $crate::instance::ComponentPointer,
            $($argument: $type),*
        ) -> $crate::instance::Status {
            let body = |$instance: &mut $crate::instance::Instance, $host: &$crate::instance::HostMemory| {
                let _ = (&$instance, $host);
                $($(
                    // SAFETY: the host's promise, see the module
                    let $argument = unsafe { $host.$check(stringify!($argument), $argument $(, $count)?) }?;
                )?)*
                $result
            };
            // SAFETY: as above
            unsafe { $crate::instance::run(c, &$call, body) }
        }
    };
    ([$shape:ident] $arguments:tt $row:tt |$instance:ident, $host:ident| $result:expr) => {
        $shape! { $arguments $row $result }
    };
}

/// Defines a function that fills an array of numbers with a method.
#[cfg(feature = "full")]
macro_rules! filled {
    (() $row:tt $method:expr) => {
        $crate::instance::export! {
            [] (values: *mut f64, count: usize) $row |instance, host| {
                // SAFETY: the host's promise, see the module
                let values = unsafe { host.output("the array", values, count) }?;
                $method(instance, values)
            }
        }
    };
}

/// Defines the function with which a host's solver reports a completed step to a method.
#[cfg(feature = "full")]
macro_rules! completed_step {
    (() $row:tt $method:expr) => {
        $crate::instance::export! {
            [] (
                _noSetFMUStatePriorToCurrentPoint: Boolean,
                enterEventMode: *mut Boolean as output_value,
                terminateSimulation: *mut Boolean as output_value
            ) $row |instance, host| {
                enterEventMode.write($method(instance)?.into());
                terminateSimulation.write(0);
                Ok(())
            }
        }
    };
}

pub(crate) use {calls, export};
#[cfg(feature = "full")]
pub(crate) use {completed_step, filled};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_returned_as_its_message() {
        assert_eq!(catch(|| 1), Ok(1));
        assert_eq!(catch(|| -> i32 { panic!("step {}", 2) }), Err("step 2".into()));
    }
}

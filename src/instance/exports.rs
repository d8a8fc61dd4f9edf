//! Macros that define the C functions of both versions of FMI. Each version has its own table `Call` and its own type
//! `Boolean`.

/// Carries out a call. `body` checks its pointers and passes them on.
macro_rules! call {
    ($c:expr, $call:ident, |$instance:pat_param, $host:pat_param| $body:expr) => {{
        let body = |$instance: &mut $crate::instance::Instance, $host: &$crate::instance::HostMemory| $body;
        // SAFETY: the host's promise, see the module
        unsafe { $crate::instance::run($c, Call::$call, body) }
    }};
}

/// Defines functions whose only argument is an instance.
macro_rules! plain {
    ($($function:ident $call:ident $method:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(c: ComponentPointer) -> Status {
            call!(c, $call, |instance, _| instance.$method())
        }
    )+};
}

/// Defines functions that fill an array of numbers.
#[cfg(feature = "full")]
macro_rules! getters {
    ($($function:ident $call:ident $method:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(c: ComponentPointer, values: *mut f64, count: usize) -> Status {
            call!(c, $call, |instance, host| {
                // SAFETY: the host's promise, see the module
                let values = unsafe { host.output("the array", values, count) }?;
                instance.$method(values)
            })
        }
    )+};
}

/// Defines the functions with which the host's solver proceeds: a completed step, the time, and the states.
#[cfg(feature = "full")]
macro_rules! host_solver {
    ($completed:ident $time:ident $states:ident $argument:literal) => {
        #[doc = concat!(stringify!($completed), ". The flag is ignored, because snapshots are complete.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $completed(
            c: ComponentPointer,
            _never_back: Boolean,
            enter_event_mode: *mut Boolean,
            terminate: *mut Boolean,
        ) -> Status {
            call!(c, CompletedIntegratorStep, |instance, host| {
                // SAFETY: the host's promise, see the module
                let (event, end) = unsafe {
                    (
                        host.output_value("enterEventMode", enter_event_mode)?,
                        host.output_value("terminateSimulation", terminate)?,
                    )
                };
                event.write(Boolean::from(instance.completed_integrator_step()?));
                end.write(0);
                Ok(())
            })
        }

        #[doc = concat!(stringify!($time), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $time(c: ComponentPointer, time: f64) -> Status {
            call!(c, SetTime, |instance, _| instance.set_time(time))
        }

        #[doc = concat!(stringify!($states), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $states(c: ComponentPointer, states: *const f64, count: usize) -> Status {
            call!(c, SetContinuousStates, |instance, host| {
                // SAFETY: the host's promise, see the module
                let states = unsafe { host.input($argument, states, count) }?;
                instance.set_continuous_states(states)
            })
        }
    };
}

/// Defines the function that sets which messages are logged. An empty list of categories means all.
macro_rules! debug_logging {
    ($function:ident) => {
        #[doc = concat!(stringify!($function), ". An empty list of categories means all.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            logging: Boolean,
            count: usize,
            categories: *const Text,
        ) -> Status {
            call!(c, SetDebugLogging, |instance, host| {
                // SAFETY: the host's promise, see the module
                unsafe { instance.configure_log(host, logging != 0, categories, count) }
            })
        }
    };
}

pub(crate) use {call, debug_logging, plain};
#[cfg(feature = "full")]
pub(crate) use {getters, host_solver};

//! Macros that define the C functions of both versions of FMI from their tables of calls.

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

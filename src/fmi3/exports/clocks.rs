//! Functions of clocks and model partitions, which the FMU does not have.

use super::*;

macro_rules! no_clocks {
    ($($function:ident($($argument:ident: $type:ty),*);)+) => {$(
        #[doc = concat!(stringify!($function), ": there are no clocks.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            references: *const ValueReference,
            count: usize,
            $($argument: $type),*
        ) -> Status {
            call!(c, Clocks, |_, host| {
                // SAFETY: the host's promise, see the module
                values::none_of(unsafe { host.input("valueReferences", references, count)? }, "Clock")
            })
        }
    )+};
}

no_clocks! {
    fmi3GetClock(_values: *mut Boolean);
    fmi3SetClock(_values: *const Boolean);
    fmi3GetIntervalDecimal(_intervals: *mut f64, _qualifiers: *mut c_int);
    fmi3GetIntervalFraction(_counters: *mut u64, _resolutions: *mut u64, _qualifiers: *mut c_int);
    fmi3GetShiftDecimal(_shifts: *mut f64);
    fmi3GetShiftFraction(_counters: *mut u64, _resolutions: *mut u64);
    fmi3SetIntervalDecimal(_intervals: *const f64);
    fmi3SetIntervalFraction(_counters: *const u64, _resolutions: *const u64);
    fmi3SetShiftDecimal(_shifts: *const f64);
    fmi3SetShiftFraction(_counters: *const u64, _resolutions: *const u64);
}

/// fmi3ActivateModelPartition, which exists only for scheduled execution.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ActivateModelPartition(c: ComponentPointer, _clock: ValueReference, _time: f64) -> Status {
    call!(c, ActivateModelPartition, |_, _| Ok(()))
}
